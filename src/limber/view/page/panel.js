// The panel beside the picture: deformation, colours, links, probes, ghosts.
import { colourOfGhost, format, kMaps, toText } from './colours.js';

function make(tag, properties = {}, children = []) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

function section(title, children, isOpen = true) {
  const details = make('details', { open: isOpen }, [make('summary', { textContent: title }), ...children]);
  return details;
}

// 1, 2, 5, 10, ..., 1e5 by a slider of its logarithm.
function deformationSection(view) {
  const number = make('input', { type: 'number', min: 1, max: 1e5, step: 'any', id: 'magnification' });
  const slider = make('input', { type: 'range', min: 0, max: 5, step: 0.01, title: 'Magnified deformation (m, M)' });
  const show = () => {
    number.value = Number(view.magnification.toPrecision(3));
    slider.value = Math.log10(view.magnification);
  };
  number.onchange = () => view.setMagnification(Number(number.value));
  slider.oninput = () => view.setMagnification(10 ** slider.value);
  view.onMagnification(show);
  show();
  const note = make('p', {
    className: 'hint',
    textContent: `largest deformation ${format(view.ranges.most[1], 'm')}; rigid motion is not magnified`,
  });
  return section('Deformation \u00d7', [make('div', { className: 'row' }, [slider, number]), note]);
}

function colourSection(view) {
  const select = make('select', { id: 'field' }, view.fields.map((field) =>
    make('option', { value: field.index, textContent: field.label })));
  select.onchange = () => view.setField(Number(select.value));
  const each = make('input', { type: 'checkbox' });
  each.onchange = () => view.setScalePerFrame(each.checked);
  const map = make('select', { id: 'map', title: 'Colour map' }, Object.keys(kMaps).map((name) =>
    make('option', { value: name, textContent: name })));
  map.onchange = () => view.setMap(map.value);
  view.onField(() => {
    select.value = view.field;
    map.value = view.map;
  });
  map.value = view.map;
  return section('Colour', [
    select,
    make('label', { className: 'row' }, ['map ', map]),
    make('label', { className: 'row' }, [each, ' scale of each moment']),
  ]);
}

function linkRow(view, link) {
  const show = make('input', { type: 'checkbox', checked: true, title: 'show' });
  show.onchange = () => view.showLink(link, show.checked);
  const name = make('button', { className: 'name', textContent: link.short, title: `${link.name} (${link.level}): follow with the camera` });
  name.onclick = () => view.follow(view.followed === link ? null : link);
  const only = make('button', { className: 'sign alone', title: 'show it alone, or all again' });
  only.onclick = () => view.isolate(link);
  const clear = make('button', { className: 'sign half', title: 'transparent or solid' });
  clear.onclick = () => view.clearLink(link);
  view.onLinks(() => {
    show.checked = link.group.visible;
    name.classList.toggle('on', view.followed === link);
    clear.classList.toggle('on', link.isClear === true);
    only.classList.toggle('on', view.isolated === link);
  });
  const mark = make('i', { className: 'mark' });
  mark.style.background = toText(link.colour);
  return make('div', { className: 'link' }, [
    show, mark, name, make('small', { textContent: link.level }), clear, only,
  ]);
}

function marksSection(view) {
  const row = (label, group) => {
    const box = make('input', { type: 'checkbox', checked: true });
    box.onchange = () => {
      group.visible = box.checked;
      view.redraw();
    };
    return make('label', { className: 'row' }, [box, label]);
  };
  const { marks } = view;
  const rows = [];
  if (marks.marks.length > 0) rows.push(row(' joints, couplers, tendons', marks.couplers));
  if (marks.forces.length > 0) rows.push(row(' loads', marks.loads));
  if (marks.touches.length > 0) {
    rows.push(row(' contacts', marks.contacts));
    if (marks.mostPressure > 0) {
      rows.push(make('p', {
        className: 'hint',
        textContent: `mean pressure in the ellipses, at most ${format(marks.mostPressure, 'Pa')}; ` +
          'friction blue: sticks, red: slips',
      }));
    }
  }
  return rows.length > 0 ? [section('Marks', rows)] : [];
}

function ghostSection(view) {
  if (view.ghosts.length === 0) return [];
  const beside = make('input', { type: 'checkbox', id: 'beside' });
  beside.onchange = () => view.setBeside(beside.checked);
  view.onLinks(() => (beside.checked = view.isBeside));
  const rows = view.ghosts.map((ghost, g) => {
    const box = make('input', { type: 'checkbox', checked: true });
    box.onchange = () => {
      ghost.group.visible = box.checked;
      view.redraw();
    };
    const mark = make('i', { className: 'mark' });
    mark.style.background = toText(colourOfGhost(g));
    return make('label', { className: 'row' }, [box, mark, ` ${ghost.label}`]);
  });
  return [section('Other results', [
    ...rows, make('label', { className: 'row' }, [beside, ' side by side']),
  ])];
}

function probeSection(view) {
  if (view.probeGroups.length === 0) return [];
  const rows = view.probeGroups.map((group) => {
    const box = make('input', { type: 'checkbox', checked: view.plots.has(group) });
    box.onchange = () => view.plots.toggle(group);
    view.onPlots(() => (box.checked = view.plots.has(group)));
    return make('label', { className: 'row' }, [box, ` ${group.name} `, make('small', { textContent: group.unit })]);
  });
  return [section('Probes', rows)];
}

/// Where the page's positions count from, after `before`; nothing where that is
/// the origin of the world.
export function describeOffset({ offset }, before) {
  return offset.some((value) => value !== 0) ? `${before}(${offset.join(', ')}) m` : '';
}

function aboutSection(view) {
  const { result } = view.motion;
  const bodies = result.bodies.filter((body) => body.error !== undefined);
  const error = Math.max(0, ...bodies.map((body) => body.error));
  const lines = [
    `${result.times.length} outputs in ${format(result.times.at(-1) - result.times[0], 's')}, from ${result.times[0]} s on`,
    `positions within ${format(error, 'm')} of the results at magnification 1 (16-bit shapes)`,
    ...bodies.filter((b) => b.truncation).map((b) => `${b.name}: motion of all nodes by ${b.modes} shapes, within ${format(b.truncation, 'm')}`),
    ...bodies.filter((b) => b.stress).map((b) => `${b.name}: its stress by ${b.stress.length} shapes, within ${format(b.stress_truncation, 'Pa')}`),
    describeOffset(result, 'far from the origin of the world: positions count from '),
    result.travels ? 'the picture moves with the mean of the bodies, which travel far' : '',
    `Limber ${result.limber}`,
  ];
  return section('About', lines.filter(Boolean).map((line) => make('p', { className: 'hint', textContent: line })), false);
}

export function fillPanel(element, view) {
  element.append(
    make('div', { id: 'picked', hidden: true }),
    deformationSection(view),
    colourSection(view),
    section('Links', view.bodies.links.map((link) => linkRow(view, link))),
    ...ghostSection(view),
    ...probeSection(view),
    ...marksSection(view),
    aboutSection(view),
  );
}
