// What stands around the canvas, drawn into pictures and films that are saved:
// title, time, magnification and legend.

const kMargin = 14; // [pixels of the page]

// Lines of text in a box that lets the picture through a little.
function drawBox(context, { x, y, lines, style, sizes }) {
  const width = Math.max(...lines.map((line, i) => {
    context.font = sizes[i];
    return context.measureText(line).width;
  }));
  context.fillStyle = style.back;
  context.globalAlpha = 0.85;
  context.fillRect(x - 6, y - 4, width + 12, 18 * lines.length + 8);
  context.globalAlpha = 1;
  context.fillStyle = style.ink;
  lines.forEach((line, i) => {
    context.font = sizes[i];
    context.fillText(line, x, y + 18 * i);
  });
}

function drawLegend(context, legend, style, y) {
  const x = kMargin;
  const height = 140;
  const small = '12px sans-serif';
  const lines = [legend.label, ...legend.notes];
  const width = Math.max(...lines.map((line) => {
    context.font = line === legend.label ? 'bold 13px sans-serif' : small;
    return context.measureText(line).width;
  }), 100);
  context.globalAlpha = 0.85;
  context.fillStyle = style.back;
  context.fillRect(x - 6, y - 4, width + 12, height + 34 + 17 * legend.notes.length);
  context.globalAlpha = 1;
  context.fillStyle = style.ink;
  context.font = 'bold 13px sans-serif';
  context.fillText(legend.label, x, y);
  const top = y + 24;
  const bar = context.createLinearGradient(0, top + height, 0, top);
  legend.stops.forEach((stop, i) => bar.addColorStop(i / (legend.stops.length - 1), stop));
  context.fillStyle = bar;
  context.fillRect(x, top, 14, height);
  context.fillStyle = style.ink;
  context.font = small;
  const { ticks } = legend;
  ticks.forEach((tick, i) => {
    const share = ticks.length > 1 ? i / (ticks.length - 1) : 1;
    context.fillText(tick, x + 22, top + share * (height - 12));
  });
  legend.notes.forEach((note, i) => context.fillText(note, x, top + height + 8 + 17 * i));
}

/// Draws the canvas and its caption into another one, of the size of the first.
/// @param caption { title, lines: texts, legend or null, style: { back, ink }, scale:
/// pixels of the canvas a pixel of the page }
export function drawWithCaption(canvas, { title, lines, legend, style, scale }, picture) {
  const context = picture.getContext('2d');
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.drawImage(canvas, 0, 0);
  context.scale(scale, scale);
  context.textBaseline = 'top';
  drawBox(context, {
    x: kMargin, y: kMargin, lines: [title], style, sizes: ['bold 15px sans-serif'],
  });
  if (legend) drawLegend(context, legend, style, kMargin + 38);
  drawBox(context, {
    x: kMargin, y: canvas.height / scale - kMargin - 18 * lines.length, lines, style,
    sizes: lines.map(() => '13px sans-serif'),
  });
}
