// Peaks, envelopes and errors of probes in their plots: what all steps showed, where
// the curve goes through the outputs alone, and how far it may be off.
import { format } from './colours.js';

const kRadius = 4; // of a peak's mark [pixels]

function includeBetween(range, times, values, from, to) {
  for (let i = 0; i < times.length; ++i) {
    if (times[i] < from || times[i] > to || !Number.isFinite(values[i])) continue;
    range[0] = Math.min(range[0], values[i]);
    range[1] = Math.max(range[1], values[i]);
  }
}

/// The range of all series with their peaks and envelopes between two times.
export function findRange(series, from, to) {
  const range = [Infinity, -Infinity];
  for (const { times, values, peak, band } of series) {
    includeBetween(range, times, values, from, to);
    if (peak) includeBetween(range, [peak.time], [peak.value], from, to);
    if (!band) continue;
    // An interval that begins before is seen, too.
    const ends = band.edges.subarray(1);
    for (const side of [band.least, band.most]) {
      includeBetween(range, ends, side, from, to);
      includeBetween(range, band.edges.subarray(0, -1), side, from, to);
    }
  }
  return range[0] <= range[1] ? range : [0, 1];
}

function clip(u) {
  const { left, top, width, height } = u.bbox;
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
}

/// Pale bands of each curve's error about it.
export function drawErrors(u, series, colours) {
  clip(u);
  u.ctx.globalAlpha = 0.15;
  series.forEach(({ times, values, error }, s) => {
    if (!error || !u.series[s + 1].show) return;
    const place = (i, side) =>
      [u.valToPos(times[i], 'x', true), u.valToPos(values[i] + side * error, 'y', true)];
    u.ctx.fillStyle = colours[s];
    u.ctx.beginPath();
    for (let i = 0; i < times.length; ++i) u.ctx.lineTo(...place(i, 1));
    for (let i = times.length - 1; i >= 0; --i) u.ctx.lineTo(...place(i, -1));
    u.ctx.fill();
  });
  u.ctx.restore();
}

/// Rectangles from least to most, behind the curves.
export function drawBands(u, series, colours) {
  clip(u);
  u.ctx.globalAlpha = 0.25;
  series.forEach(({ band }, s) => {
    if (!band || !u.series[s + 1].show) return;
    u.ctx.fillStyle = colours[s];
    for (let k = 0; k < band.least.length; ++k) {
      const least = band.least[k];
      const most = band.most[k];
      if (!Number.isFinite(least) || !Number.isFinite(most)) continue;
      const x = u.valToPos(band.edges[k], 'x', true);
      const y = u.valToPos(most, 'y', true);
      u.ctx.fillRect(
        x, y, u.valToPos(band.edges[k + 1], 'x', true) - x,
        Math.max(1, u.valToPos(least, 'y', true) - y));
    }
  });
  u.ctx.restore();
}

/// A circle at each peak with its value.
export function drawPeaks(u, series, colours, unit) {
  const scale = devicePixelRatio;
  const { left, width } = u.bbox;
  clip(u);
  u.ctx.setLineDash([]);
  u.ctx.lineWidth = 1.5 * scale;
  u.ctx.font = `${11 * scale}px sans-serif`;
  u.ctx.textBaseline = 'bottom';
  series.forEach(({ peak }, s) => {
    if (!peak || peak.value === 0 || !u.series[s + 1].show) return;
    const x = u.valToPos(peak.time, 'x', true);
    const y = u.valToPos(peak.value, 'y', true);
    u.ctx.strokeStyle = u.ctx.fillStyle = colours[s];
    u.ctx.beginPath();
    u.ctx.arc(x, y, kRadius * scale, 0, 2 * Math.PI);
    u.ctx.stroke();
    const isLate = x > left + width / 2;
    u.ctx.textAlign = isLate ? 'right' : 'left';
    u.ctx.fillText(format(peak.value, unit), x + (isLate ? -7 : 7) * scale, y - 2 * scale);
  });
  u.ctx.restore();
}
