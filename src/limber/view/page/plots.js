// Plots of probes and picked points over time, with a cursor at the page's time.
import uPlot from 'uplot';
import { format, labelTicks } from './colours.js';
import { drawBands, drawErrors, drawPeaks, findRange } from './extremes.js';

const kDashes = [[6, 4], [2, 3], [10, 3, 2, 3]]; // of ghosts
const kColours = ['#4e79a7', '#e15759', '#59a14f', '#f28e2b', '#b07aa1', '#76b7b2', '#9c755f'];

/// Probes by the part of their names before the last dot.
export function groupProbes(results) {
  const groups = new Map();
  results.forEach((result, r) => {
    for (const probe of result.probes) {
      const dot = probe.name.lastIndexOf('.');
      const name = dot > 0 ? probe.name.slice(0, dot) : probe.name;
      const label = dot > 0 ? probe.name.slice(dot + 1) : probe.name;
      const id = `${name} [${probe.unit}]`;
      if (!groups.has(id)) groups.set(id, { name, unit: probe.unit, series: [] });
      groups.get(id).series.push({
        label, values: probe.values, times: result.times, ghost: r,
        peak: probe.peak, band: probe.band, error: probe.error,
      });
    }
  });
  return [...groups.values()];
}

function labelOf(series, unit) {
  const error = series.error ? ` \u00b1 ${format(Number(series.error.toPrecision(2)), unit)}` : '';
  if (!series.ghost) return series.label + error;
  return `${series.label}${error} (${series.ghostName ?? `ghost ${series.ghost}`})`;
}

// One list of times for all series; gaps where a series has none.
function align(series) {
  const times = series[0].times;
  if (series.every((s) => s.times === times)) return [times, ...series.map((s) => s.values)];
  return uPlot.join(series.map((s) => [s.times, s.values]));
}

export class Plots {
  constructor(element, player) {
    this.element = element;
    this.player = player;
    this.shown = []; // { group, plot, box }
    player.onChange(() => this.moveCursor());
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(element);
  }

  has(group) {
    return this.shown.some((item) => item.group === group);
  }

  toggle(group) {
    if (this.has(group)) this.remove(group);
    else this.add(group);
  }

  add(group) {
    const box = document.createElement('div');
    box.className = 'plot';
    this.element.append(box);
    this.element.hidden = false;
    this.shown.push({ group, box, plot: null });
    this.rebuild();
  }

  remove(group) {
    const item = this.shown.find((other) => other.group === group);
    item.plot?.destroy();
    item.box.remove();
    this.shown = this.shown.filter((other) => other !== item);
    this.element.hidden = this.shown.length === 0;
    this.rebuild();
  }

  rebuild() {
    for (const item of this.shown) {
      item.plot?.destroy();
      item.plot = this.make(item);
    }
    this.moveCursor();
  }

  make({ group, box }) {
    const style = getComputedStyle(document.body);
    const ink = style.getPropertyValue('--ink');
    const labels = [...new Set(group.series.map((s) => s.label))];
    const colours = group.series.map(
      (s) => kColours[labels.indexOf(s.label) % kColours.length]);
    const findY = (u) => {
      const { min, max } = u.scales.x;
      const [least, most] = findRange(group.series, min ?? -Infinity, max ?? Infinity);
      return uPlot.rangeNum(least, most, 0.1, true);
    };
    const axis = { stroke: ink, grid: { stroke: style.getPropertyValue('--line'), width: 1 }, font: '11px sans-serif' };
    const plot = new uPlot(
      {
        ...this.sizeOf(box),
        title: `${group.name} [${group.unit}]`,
        scales: { x: { time: false }, y: { range: findY } },
        cursor: { drag: { x: true, y: false }, points: { show: false } },
        legend: { live: false },
        axes: [
          { ...axis, size: 28, values: (_, ticks) => labelTicks(ticks, 's'), space: 70 },
          { ...axis, size: 64, values: (_, ticks) => labelTicks(ticks, group.unit) },
        ],
        series: [
          { label: 'time' },
          ...group.series.map((s, i) => ({
            label: labelOf(s, group.unit),
            stroke: colours[i],
            width: s.ghost ? 1 : 1.5,
            dash: s.ghost ? kDashes[(s.ghost - 1) % kDashes.length] : undefined,
            points: { show: false },
            spanGaps: true,
          })),
        ],
        hooks: {
          drawAxes: [
            (u) => drawErrors(u, group.series, colours),
            (u) => drawBands(u, group.series, colours),
          ],
          draw: [
            (u) => drawPeaks(u, group.series, colours, group.unit),
            (u) => this.drawTime(u),
          ],
        },
      },
      align(group.series),
      box,
    );
    plot.over.addEventListener('click', () => {
      if (plot.cursor.left < 0 || plot.select.width > 2) return;
      this.player.pause();
      this.player.seek(plot.posToVal(plot.cursor.left, 'x'));
    });
    return plot;
  }

  drawTime(u) {
    const x = Math.round(u.valToPos(this.player.time, 'x', true));
    if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
    u.ctx.save();
    u.ctx.setLineDash([]);
    u.ctx.strokeStyle = '#d62728';
    u.ctx.lineWidth = 1.5 * devicePixelRatio;
    u.ctx.beginPath();
    u.ctx.moveTo(x, u.bbox.top);
    u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
    u.ctx.stroke();
    u.ctx.restore();
  }

  sizeOf(box) {
    return { width: Math.max(160, box.clientWidth), height: Math.max(90, box.clientHeight - 50) };
  }

  resize() {
    for (const { plot, box } of this.shown) plot?.setSize(this.sizeOf(box));
  }

  moveCursor() {
    if (this.element.hidden) return;
    for (const { plot } of this.shown) plot?.redraw(false);
  }
}
