// Colours of links and ghosts, the scale of fields, and its legend.
import * as THREE from 'three';
import { kFields } from './material.js';

const kLinks = [0x4e79a7, 0xf28e2b, 0x59a14f, 0xb07aa1, 0x76b7b2, 0xedc948, 0xe15759, 0x9c755f];
const kGhosts = [0xd62728, 0x9467bd, 0x2ca02c, 0x8c564b];

export const colourOfLink = (i) => kLinks[i % kLinks.length];
export const colourOfGhost = (i) => kGhosts[i % kGhosts.length];
export const toText = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

// Turbo (Mikhailov, 2019) without its dark ends, sampled; linear between.
const kTurbo = [
  [74, 84, 205], [70, 117, 237], [57, 162, 252], [27, 207, 212], [36, 236, 166],
  [97, 252, 108], [164, 252, 59], [209, 232, 52], [243, 198, 58], [254, 155, 45], [243, 99, 21],
  [217, 56, 6], [177, 25, 1],
];

/// Red, green and blue of 0 to 255 at f of 0 to 1.
export function turbo(f) {
  const at = f * (kTurbo.length - 1);
  const i = Math.min(kTurbo.length - 2, Math.floor(at));
  return [0, 1, 2].map((c) => kTurbo[i][c] + (at - i) * (kTurbo[i + 1][c] - kTurbo[i][c]));
}

export function makeMap() {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) data.set([...turbo(i / 255), 255], 4 * i);
  const map = new THREE.DataTexture(data, 256, 1);
  map.colorSpace = THREE.SRGBColorSpace;
  map.minFilter = map.magFilter = THREE.LinearFilter;
  map.needsUpdate = true;
  return map;
}

/// 1.23 mm, 4.5 um, ...: a value with a prefix of its unit.
export function format(value, unit) {
  if (value === 0) return `0 ${unit}`;
  if (unit === 'Pa') {
    const [factor, prefix] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, '']].find(
      ([f]) => Math.abs(value) >= 0.9995 * f) ?? [1, ''];
    return `${Number((value / factor).toPrecision(4))} ${prefix}Pa`;
  }
  const prefixes = [[1, ''], [1e-3, 'm'], [1e-6, '\u00b5'], [1e-9, 'n'], [1e-12, 'p']];
  const size = Math.abs(value);
  const known = /^(m|s|m\/s|rad|N|J|N m|rad\/s)$/.test(unit);
  const [factor, prefix] =
    (known && size < 1 && prefixes.find(([f]) => size >= 0.9995 * f)) || [1, ''];
  const scaled = value / factor;
  const text =
    Math.abs(scaled) >= 1e5 || Math.abs(scaled) < 1e-3
      ? scaled.toExponential(2)
      : String(Number(scaled.toPrecision(4)));
  return `${text} ${prefix}${unit}`.trim();
}

/// Texts of an axis; of ticks that differ by less than four digits show, the
/// first, and the others from it.
export function labelTicks(ticks, unit) {
  const [first] = ticks;
  const most = Math.max(...ticks.map(Math.abs));
  if (ticks.at(-1) - first > 1e-3 * most) {
    return ticks.map((value) => (value === 0 ? '0' : format(value, unit)));
  }
  return ticks.map((value, i) =>
    i === 0 ? `${Number(first.toPrecision(15))} ${unit}` : `+${format(value - first, unit)}`);
}

const kGradient = Array.from({ length: 13 }, (_, i) => `rgb(${turbo(i / 12).map(Math.round)})`);

/// @param most at its upper end; its lower one is zero
export function showLegend(element, field, most, note) {
  const { label, unit } = kFields[field];
  element.hidden = field === 0;
  if (field === 0) return;
  const ticks = most > 0 ? [most, most / 2, 0] : [0];
  element.innerHTML =
    `<div class="legend-title">${label}</div><div class="legend-body">` +
    `<div class="legend-bar" style="background:linear-gradient(to top,${kGradient})"></div>` +
    `<div class="legend-ticks">${ticks.map((v) => `<span>${format(v, unit)}</span>`).join('')}</div>` +
    `</div><div class="legend-note">${note}</div>`;
}
