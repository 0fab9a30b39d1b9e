// The page of `limber view`.
import { kPresets } from './camera.js';
import { format, kMaps } from './colours.js';
import { readResults } from './data.js';
import { describeOffset, fillPanel } from './panel.js';
import { describeNode, pickAt, traceNode, traceStress, watchPicks } from './pick.js';
import { Player } from './player.js';
import { save, takeFilm, takePicture } from './record.js';
import { stressModesOf } from './stress.js';
import { Timeline } from './timeline.js';
import { View } from './view.js';

const find = (id) => document.getElementById(id);

const kKeys = [
  ['space', 'play or pause'],
  ['\u2190 \u2192', 'previous, next output; with shift ten'],
  ['Home End', 'start, end'],
  ['+ \u2212', 'faster, slower'],
  ['[ ] \\', 'the interval begins, ends here; the whole run'],
  ['m M', 'deformation magnified twice as much, half as much'],
  ['c', 'next colouring'],
  ['f', 'frame the whole motion'],
  ['1 2 3 4', kPresets.join(', ')],
  ['k', 'the moment of the largest deformation'],
  ['n', 'names of links'],
  ['p', 'plots'],
  ['s r', 'save a picture, a film of the interval'],
  ['d', 'dark or light'],
  ['b', 'other results beside the shown one, or as its ghosts'],
  ['o', 'the panel'],
  ['click', 'a point of a surface: its node, displacement and stress'],
];

function setDark(isDark, view) {
  document.documentElement.classList.toggle('dark', isDark);
  view?.setDark(isDark);
}

function togglePanel() {
  document.body.classList.toggle('panel-toggled');
  find('panel-button').classList.toggle('on');
}

function togglePlots(view) {
  const { plots } = view;
  if (plots.shown.length > 0) {
    view.lastPlots = plots.shown.map((item) => item.group);
    for (const group of view.lastPlots) plots.remove(group);
  } else {
    for (const group of view.lastPlots ?? view.probeGroups.slice(0, 2)) plots.add(group);
  }
  view.tell('plots');
}

// What the saved picture says beside what it shows.
function makeCaption(view, player, name) {
  const style = getComputedStyle(document.documentElement);
  const { magnification } = view;
  const ghosts = view.ghosts.filter((ghost) => ghost.group.visible).map((ghost) => ghost.label);
  return {
    title: name,
    legend: view.legend,
    lines: [
      `t = ${format(player.time, 's')}` +
        (magnification === 1 ? '' : `, deformation \u00d7 ${Number(magnification.toPrecision(3))}`),
      ...(ghosts.length > 0 ? [`${view.isBeside ? 'beside it' : 'ghosts'}: ${ghosts.join(', ')}`] : []),
    ],
    style: { back: style.getPropertyValue('--back'), ink: style.getPropertyValue('--ink') },
    scale: view.renderer.getPixelRatio(),
  };
}

async function savePicture(view, player, name) {
  const picture = await takePicture(
    find('canvas'), () => view.draw(), () => makeCaption(view, player, name));
  save(picture, `${name}.png`);
}

async function saveFilm(view, player, name) {
  find('film').classList.add('on');
  try {
    const film = await takeFilm(
      find('canvas'), () => view.draw(), () => makeCaption(view, player, name), player);
    save(film, `${name}.webm`);
  } catch (error) {
    tellNote(error.message);
  }
  find('film').classList.remove('on');
}

function tellNote(text) {
  find('note').textContent = text;
  find('note').hidden = false;
  setTimeout(() => (find('note').hidden = true), 4000);
}

function makeActions(view, player, name) {
  const isDark = () => document.documentElement.classList.contains('dark');
  return {
    ' ': () => player.toggle(),
    ArrowLeft: (e) => player.step(e.shiftKey ? -10 : -1),
    ArrowRight: (e) => player.step(e.shiftKey ? 10 : 1),
    Home: () => player.seek(player.start),
    End: () => player.seek(player.end),
    '+': () => player.faster(1),
    '=': () => player.faster(1),
    '-': () => player.faster(-1),
    '[': () => player.setInterval(player.time, player.to),
    ']': () => player.setInterval(player.from, player.time),
    '\\': () => player.setInterval(player.start, player.end),
    m: () => view.setMagnification(2 * view.magnification),
    M: () => view.setMagnification(view.magnification / 2),
    c: () => view.setField((view.field + 1) % view.fields.length),
    f: () => {
      view.camera.frame();
      view.redraw();
    },
    k: () => player.seek(view.ranges.peak),
    n: () => {
      view.names.toggle();
      view.redraw();
    },
    p: () => togglePlots(view),
    s: () => savePicture(view, player, name),
    r: () => saveFilm(view, player, name),
    d: () => setDark(!isDark(), view),
    b: () => view.setBeside(!view.isBeside),
    o: () => togglePanel(),
    '?': () => find('help').showModal(),
    ...Object.fromEntries(
      kPresets.map((preset, i) => [
        String(i + 1),
        () => {
          view.camera.show(preset);
          view.redraw();
        },
      ]),
    ),
  };
}

function connectButtons(actions) {
  const empty = {};
  find('panel-button').onclick = () => actions.o();
  find('plots-button').onclick = () => actions.p();
  find('picture').onclick = () => actions.s();
  find('film').onclick = () => actions.r();
  find('dark-button').onclick = () => actions.d();
  find('help-button').onclick = () => actions['?']();
  kPresets.forEach((preset, i) => {
    const button = document.createElement('button');
    button.textContent = preset;
    button.title = `Look at it so (${i + 1})`;
    button.onclick = () => actions[String(i + 1)](empty);
    find('presets').append(button);
  });
  find('help').innerHTML =
    '<h2>Keys</h2><table>' +
    kKeys.map(([key, what]) => `<tr><th>${key}</th><td>${what}</td></tr>`).join('') +
    '</table><form method="dialog"><button>Close</button></form>';
}

function connectKeys(actions) {
  addEventListener('keydown', (event) => {
    const isText = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    const isSlider = event.target.type === 'range' || event.target.type === 'checkbox';
    if ((isText && !isSlider) || event.ctrlKey || event.metaKey || event.altKey) return;
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

function showPick(view, player, pick) {
  view.pick = pick;
  const box = find('picked');
  box.hidden = !pick;
  if (!pick) return view.redraw();
  const { result } = view.motion;
  const body = result.bodies[pick.body];
  const fill = () => {
    if (!view.pick) return;
    const { node } = view.pick;
    if (node < 0) {
      box.textContent = `${body.name}: a rigid body`;
      return;
    }
    const now = describeNode(view.motion, view.pick.body, node, player.time);
    box.querySelector('p').innerHTML =
      `node <b>${now.tag}</b> of <b></b><br>at ${now.position.map((value, c) => format(value - result.offset[c], 'm')).join(', ')}` +
      describeOffset(result, ' from ') +
      `<br>displaced ${format(now.displacement, 'm')}, deformed ${format(now.deformation, 'm')}` +
      (now.stress === null ? '' : `<br>von Mises stress ${format(now.stress, 'Pa')}`);
    box.querySelectorAll('b')[1].textContent = body.name;
  };
  if (pick.node >= 0) {
    box.innerHTML = '<p></p>';
    const offer = (what, traceIt) => {
      const button = document.createElement('button');
      button.textContent = `Plot its ${what}`;
      button.onclick = () => view.plots.add(traceIt(view.motion, pick.body, pick.node));
      box.append(button);
    };
    offer('displacement', traceNode);
    if (stressModesOf(result, body)) offer('stress', traceStress);
  }
  view.fillPick = fill;
  fill();
  return view.redraw();
}

// #peak, #t=0.01, #magnification=100, #field=deformation, #map=cividis, #beside, #dark,
// #plots; joined by &.
function readHash(view, player) {
  const wishes = new URLSearchParams(location.hash.slice(1));
  if (wishes.has('peak')) player.seek(view.ranges.peak);
  if (wishes.has('t')) player.seek(Number(wishes.get('t')) || 0);
  if (wishes.has('magnification')) view.setMagnification(Number(wishes.get('magnification')));
  const field = view.fields.find(({ name }) => name === wishes.get('field'));
  if (field) view.setField(field.index);
  if (wishes.get('map') in kMaps) view.setMap(wishes.get('map'));
  if (wishes.has('beside')) view.setBeside(true);
  if (wishes.has('dark')) setDark(true, view);
  if (wishes.has('plots') && view.probeGroups.length > 0) togglePlots(view);
}

function run(view, player) {
  let last = performance.now();
  const frame = (now) => {
    requestAnimationFrame(frame);
    player.advance((now - last) / 1000);
    last = now;
    if (view.isStale) view.draw();
  };
  requestAnimationFrame(frame);
}

async function start() {
  const results = await readResults();
  const [result] = results;
  setDark(matchMedia('(prefers-color-scheme: dark)').matches, null);
  document.title = `${result.name} \u2013 Limber`;
  find('title').textContent = result.name;
  const levels = [...new Set(result.bodies.map((body) => body.level))].join(', ');
  find('subtitle').textContent = `${result.bodies.length} ${result.bodies.length === 1 ? 'body' : 'bodies'}, ${levels}`;
  const player = new Player(result.times);
  const view = new View(results, player, {
    canvas: find('canvas'), stage: find('stage'), legend: find('legend'),
    names: find('names'), plots: find('plot-area'),
  });
  new Timeline(find('bar'), player, result.events);
  fillPanel(find('panel'), view);
  const actions = makeActions(view, player, result.name);
  connectButtons(actions);
  connectKeys(actions);
  watchPicks(find('canvas'), view.camera.eye, view.bodies, (pick) => showPick(view, player, pick));
  player.onChange(() => view.fillPick?.());
  readHash(view, player);
  run(view, player);
  // For tests, and for consoles.
  window.limber = {
    results, player, view, actions, pickAt: (x, y) => pickAt(x, y, view.camera.eye, view.bodies),
    traceStress, makeCaption: () => makeCaption(view, player, result.name),
  };
}

start().catch((error) => {
  document.body.innerHTML = '<p id="failure"></p>';
  find('failure').textContent = `This page cannot be shown: ${error.message}`;
  console.error(error);
});
