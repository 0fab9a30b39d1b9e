// Colours of links and ghosts, the scale of fields, and its legend.
import * as THREE from 'three';
import { kFields } from './material.js';

const kLinks = [0x4e79a7, 0xf28e2b, 0x59a14f, 0xb07aa1, 0x76b7b2, 0xedc948, 0xe15759, 0x9c755f];
const kGhosts = [0xd62728, 0x9467bd, 0x2ca02c, 0x8c564b];

export const colourOfLink = (i) => kLinks[i % kLinks.length];
/// Of links without the quantity that colours the others.
export const kBare = 0xb4b8bf;
export const colourOfGhost = (i) => kGhosts[i % kGhosts.length];
export const toText = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

/// Maps from a share of the scale to a colour, sampled; linear between. Lightness
/// grows along the first two, which colour-blind readers read as others do: viridis
/// (van der Walt and Smith, 2015), cividis (Nunez, Anderton and Renslow, 2018);
/// turbo (Mikhailov, 2019) without its dark ends.
export const kMaps = {
  viridis: [
    0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b,
    0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725,
  ],
  cividis: [
    0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173, 0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55,
    0xfee838,
  ],
  turbo: [
    0x4a54cd, 0x4675ed, 0x39a2fc, 0x1bcfd4, 0x24eca6, 0x61fc6c, 0xa4fc3b, 0xd1e834, 0xf3c63a,
    0xfe9b2d, 0xf36315, 0xd93806, 0xb11901,
  ],
};

const toParts = (rgb) => [rgb >> 16, (rgb >> 8) & 0xff, rgb & 0xff];

/// Red, green and blue of 0 to 255 at f of 0 to 1 of a map's name.
export function sampleMap(name, f) {
  const map = kMaps[name];
  const at = f * (map.length - 1);
  const i = Math.min(map.length - 2, Math.floor(at));
  const [low, high] = [toParts(map[i]), toParts(map[i + 1])];
  return low.map((value, c) => value + (at - i) * (high[c] - value));
}

export function makeMap() {
  const map = new THREE.DataTexture(new Uint8Array(256 * 4), 256, 1);
  map.colorSpace = THREE.SRGBColorSpace;
  map.minFilter = map.magFilter = THREE.LinearFilter;
  return map;
}

export function fillMap(map, name) {
  const { data } = map.image;
  for (let i = 0; i < 256; ++i) data.set([...sampleMap(name, i / 255), 255], 4 * i);
  map.needsUpdate = true;
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

/// Colours of a map from its lower to its upper end, as texts.
export const listStops = (name) =>
  Array.from({ length: 13 }, (_, i) => `rgb(${sampleMap(name, i / 12).map(Math.round)})`);

/// What the legend of a field says: { label, ticks, stops, notes }; null of no field.
/// @param most at its upper end; its lower one is zero
/// @param bare names of links without the field
export function makeLegend(field, most, scope, map, bare) {
  if (field === 0) return null;
  const { label, unit, without } = kFields[field];
  const ticks = (most > 0 ? [most, most / 2, 0] : [0]).map((v) => format(v, unit));
  const notes = [scope];
  if (bare.length > 0) {
    const who = bare.length > 3 ? `${bare.length} links` : bare.join(', ');
    notes.push(`grey: ${who} (${without})`);
  }
  return { label, ticks, stops: listStops(map), notes };
}

export function showLegend(element, legend) {
  element.hidden = !legend;
  if (!legend) return;
  element.innerHTML =
    `<div class="legend-title">${legend.label}</div><div class="legend-body">` +
    `<div class="legend-bar" style="background:linear-gradient(to top,${legend.stops})"></div>` +
    `<div class="legend-ticks">${legend.ticks.map((v) => `<span>${v}</span>`).join('')}</div></div>`;
  for (const note of legend.notes) {
    element.append(Object.assign(document.createElement('div'), {
      className: 'legend-note', textContent: note,
    }));
  }
}
