// The page of `limber view --play`: the dynamics in a worker, what they give in the page
// of `limber view`, which is in a frame.
import { format } from './colours.js';
import { inflate } from './data.js';
import { Controls } from './play_controls.js';
import { workPlayground } from './play_worker.js';

const find = (id) => document.getElementById(id);
const kLevel = 'level';  // of a control, beside paths of settings

function startWorker(setup) {
  const text = `${setup.glue}\n(${workPlayground.toString()})();`;
  const worker = new Worker(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
  worker.postMessage({ wasm: setup.module, files: setup.files, bodies: setup.bodies });
  return worker;
}

// What a visitor chose in the last picture.
function takeLook(limber) {
  if (!limber) return null;
  const { view, player } = limber;
  return {
    eye: view.camera.eye.position.clone(), target: view.camera.controls.target.clone(),
    magnification: view.magnification, field: view.field, isBeside: view.isBeside,
    time: player.time, isPlaying: player.isPlaying, speed: player.speed,
  };
}

function giveLook({ view, player }, look) {
  if (!look) return player.play();
  view.camera.eye.position.copy(look.eye);
  view.camera.controls.target.copy(look.target);
  view.camera.controls.update();
  view.setMagnification(look.magnification);
  view.setField(look.field);
  view.setBeside(look.isBeside);
  player.setSpeed(look.speed);
  player.seek(look.time);
  if (look.isPlaying) player.play();
}

class Frames {
  constructor(place, page) {
    this.place = place;
    this.page = page;
    this.current = null;
  }

  // The new picture takes the old one's place when it is drawn.
  async show(bytes) {
    const frame = document.createElement('iframe');
    frame.limberData = bytes;
    frame.style.visibility = 'hidden';
    frame.srcdoc = this.page;
    this.place.append(frame);
    for (;;) {
      await new Promise((done) => setTimeout(done, 20));
      if (frame.contentDocument?.getElementById('failure')) break;
      if (frame.contentWindow?.limber?.view.isStale === false) break;
    }
    const { limber } = frame.contentWindow;
    if (limber) giveLook(limber, takeLook(this.current?.contentWindow.limber));
    frame.style.visibility = '';
    this.current?.remove();
    this.current = frame;
    return limber;
  }
}

function showPeaks(results) {
  const rows = results[0].probes.filter((probe) => probe.peak).map((probe) => {
    const row = document.createElement('tr');
    const name = Object.assign(document.createElement('th'), { textContent: probe.name });
    row.append(name, ...results.map((result) => {
      const peak = result.probes.find((other) => other.name === probe.name)?.peak;
      return Object.assign(document.createElement('td'), {
        textContent: peak ? format(peak.value, probe.unit) : '',
        title: peak ? `at ${format(peak.time, 's')}` : '',
      });
    }));
    return row;
  });
  const head = document.createElement('tr');
  for (const text of ['Peak', 'flexible', 'rigid'].slice(0, results.length + 1)) {
    head.append(Object.assign(document.createElement('th'), { textContent: text }));
  }
  find('peaks').replaceChildren(head, ...rows);
}

// Rows of `energy`: time, total, elastic, work, dissipated since the start.
function showEnergy(energy) {
  const [first] = energy;
  const most = Math.max(...energy.flatMap(([, total, , work]) => [Math.abs(total), Math.abs(work)])) || 1;
  const least = Math.min(0, ...energy.flatMap(([, total, , work]) => [total, work]));
  const end = energy[energy.length - 1][0];
  const trace = (column, name) => {
    const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
    path.setAttribute('class', name);
    path.setAttribute('d', energy.map((row, i) => {
      const x = (300 * (row[0] - first[0])) / (end - first[0] || 1);
      const y = 96 - (92 * (row[column] - least)) / (most - least);
      return `${i === 0 ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`;
    }).join(''));
    return path;
  };
  find('energy').replaceChildren(trace(1, 'total'), trace(3, 'work'));
  const open = Math.max(...energy.map(
    ([, total, , work, lost]) => Math.abs(total - first[1] - work + lost)));
  find('open').textContent =
    `total (line) and work (dashed), at most ${format(most, 'J')}; open ${format(open, 'J')}`;
}

function showPace([answer], seconds) {
  const ratio = answer.simulated / answer.stepping;
  find('pace').textContent =
    `${answer.steps} steps of ${((1e6 * answer.stepping) / answer.steps).toFixed(1)} \u00b5s, ` +
    `${answer.modes} modes: ${ratio >= 1 ? `${ratio.toFixed(1)} \u00d7 real time` : `${(1 / ratio).toFixed(1)} \u00d7 slower than real time`}` +
    `; picture after ${seconds.toFixed(2)} s`;
}

async function start() {
  const element = find('limber-data');
  const setup = JSON.parse(new TextDecoder().decode(await inflate(element.textContent.trim())));
  element.remove();
  document.title = `${setup.name} \u2013 Limber`;
  find('title').textContent = setup.name;
  const frames = new Frames(find('frames'), setup.view);
  const worker = startWorker(setup);
  let isBusy = true;  // until it is loaded
  let isStale = true;
  let asked = 0;

  const ask = () => {
    isStale = true;
    history.replaceState(null, '', `#${controls.toHash()}`);
    if (isBusy) return;
    isBusy = true;
    isStale = false;
    asked = performance.now();
    const settings = [
      ...setup.settings,
      ...controls.changed().filter(([path]) => path !== kLevel).map(([path, value]) => `${path}=${value}`),
    ];
    const level = controls.get(kLevel) ?? '';
    const runs = [{ level: level === setup.level ? '' : level, settings }];
    if (setup.hasRigid && level !== 'rigid') runs.push({ level: 'rigid', settings });
    worker.postMessage({ scenario: setup.scenario, runs });
  };
  const controls = new Controls(find('controls'), setup.controls, ask);
  controls.readHash(location.hash);
  find('reset').onclick = (event) => {
    event.preventDefault();
    controls.reset();
    ask();
  };
  find('link').onclick = () => navigator.clipboard?.writeText(location.href);
  addEventListener('hashchange', () => {
    controls.reset();
    controls.readHash(location.hash);
    ask();
  });

  worker.onmessage = async ({ data }) => {
    find('problem').hidden = !data.problem;
    find('problem').textContent = data.problem ?? '';
    if (data.answers) {
      const limber = await frames.show(data.bytes);
      showPace(data.answers, (performance.now() - asked) / 1000);
      showEnergy(data.answers[0].energy);
      if (limber) showPeaks(limber.results);
      window.limberPlay.shown += 1;
    }
    isBusy = data.isBroken === true;
    if (isStale) ask();
  };
  worker.onerror = (event) => {
    find('problem').hidden = false;
    find('problem').textContent = `The dynamics cannot be run here: ${event.message}`;
  };
  window.limberPlay = { controls, frames, ask, shown: 0 };  // for tests, and consoles
}

start().catch((error) => {
  find('problem').hidden = false;
  find('problem').textContent = `This page cannot be shown: ${error.message}`;
  console.error(error);
});
