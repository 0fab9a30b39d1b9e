// The page of `limber view --play`: the dynamics in a worker, what they give in the page
// of `limber view`, which is in a frame.
import { format } from './colours.js';
import { inflate } from './data.js';
import { Controls } from './play_controls.js';
import { workPlayground } from './play_worker.js';

const find = (id) => document.getElementById(id);
const kLevel = 'level';  // path of a control
const kPatience = 1.5;  // after which a run that is out of date is ended [s]

// The module in its worker. What it is asked while it works waits for its answer, or, when
// that takes long, a new worker begins with it.
class Dynamics {
  constructor(setup, hear) {
    this.setup = setup;
    this.hear = hear;
    const text = `${setup.glue}\n(${workPlayground.toString()})();`;
    this.script = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
    this.start();
  }

  start() {
    const { setup } = this;
    this.worker?.terminate();
    const worker = new Worker(this.script);
    const isCurrent = () => worker === this.worker;
    worker.onmessage = ({ data }) => isCurrent() && this.hear(data);
    worker.onerror = (event) => isCurrent() &&
      this.hear({ problem: `The dynamics cannot be run here: ${event.message}`, isBroken: true });
    worker.postMessage({ wasm: setup.module, files: setup.files, bodies: setup.bodies });
    this.worker = worker;
    this.asked = null;
  }

  ask(runs) {
    this.asked = performance.now();
    this.worker.postMessage({ scenario: this.setup.scenario, runs });
  }

  get waited() {
    return this.asked === null ? 0 : (performance.now() - this.asked) / 1000;
  }
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
    // Browsers keep few drawings in three dimensions alive.
    this.current?.contentWindow.limber?.view.renderer.dispose();
    this.current?.contentWindow.limber?.view.renderer.forceContextLoss();
    this.current?.remove();
    this.current = frame;
    return limber;
  }
}

function showPeaks(results, levels) {
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
  for (const text of ['Peak', ...levels]) {
    head.append(Object.assign(document.createElement('th'), { textContent: text }));
  }
  find('peaks').replaceChildren(head, ...rows);
}

// Rows of `energy`: time, total, elastic, work, dissipated since the start.
function showEnergy(energy) {
  const [first] = energy;
  const drawn = energy.flatMap(([, total, , work]) => [total, work]);
  const most = Math.max(...drawn.map(Math.abs)) || 1;
  const least = Math.min(0, ...drawn);
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

function describeStep({ stepping, steps }) {
  return `${((1e6 * stepping) / steps).toFixed(1)} \u00b5s`;
}

function showPace(answers, levels, seconds) {
  const [answer, rigid] = answers;
  const ratio = answer.simulated / answer.stepping;
  const pace = ratio >= 1
    ? `${ratio.toFixed(1)} \u00d7 faster than real time` : `${(1 / ratio).toFixed(1)} \u00d7 slower than real time`;
  find('pace').textContent =
    `${pace}: ${answer.simulated} s in ${answer.stepping.toFixed(2)} s, ${answer.steps} steps of ` +
    `${describeStep(answer)}${rigid ? ` (${levels[1]}: ${describeStep(rigid)})` : ''}, ` +
    `${answer.modes} modes; picture after ${seconds.toFixed(2)} s`;
}

function list(id, texts) {
  find(id).replaceChildren(...texts.map(
    (text) => Object.assign(document.createElement('li'), { textContent: text })));
}

function copyLink(button) {
  const say = (text) => {
    button.textContent = text;
    setTimeout(() => (button.textContent = 'Copy a link to these settings'), 2000);
  };
  Promise.resolve(navigator.clipboard?.writeText(location.href) ?? Promise.reject()).then(
    () => say('Copied'), () => say('Not allowed: copy the address'));
}

async function start() {
  const element = find('limber-data');
  const setup = JSON.parse(new TextDecoder().decode(await inflate(element.textContent.trim())));
  element.remove();
  document.title = `${setup.name} \u2013 Limber`;
  find('title').textContent = setup.name;
  const frames = new Frames(find('frames'), setup.view);
  const state = { isBusy: true, isStale: true, levels: [], shown: 0 };  // busy until it is loaded

  const takeRuns = () => {
    const settings = [...setup.settings, ...controls.settings()];
    const level = controls.get(kLevel);
    const runs = [settings];
    state.levels = [level ?? ''];
    if (setup.hasRigid && level !== 'rigid') {
      runs.push([...settings.filter((text) => !text.startsWith(`${kLevel}=`)), `${kLevel}=rigid`]);
      state.levels.push('rigid');
    }
    return runs;
  };
  const ask = () => {
    state.isStale = true;
    history.replaceState(null, '', `#${controls.toHash()}`);
    if (state.isBusy && dynamics.waited > kPatience) dynamics.start();
    if (state.isBusy) return;
    state.isBusy = true;
    state.isStale = false;
    dynamics.ask(takeRuns());
  };
  const change = () => {
    list('refused', []);
    ask();
  };
  const readHash = () => list('refused', controls.readHash(location.hash));
  const controls = new Controls(find('controls'), setup.controls, change);
  find('reset').onclick = () => {
    controls.reset();
    change();
  };
  find('link').onclick = () => copyLink(find('link'));
  addEventListener('hashchange', () => {
    controls.reset();
    readHash();
    ask();
  });

  const show = async ({ answers, bytes }) => {
    const { waited } = dynamics;
    const { levels } = state;
    dynamics.asked = null;
    const limber = await frames.show(bytes);
    showPace(answers, levels, waited);
    showEnergy(answers[0].energy);
    list('notices', answers[0].warnings);
    if (limber) showPeaks(limber.results, levels);
    state.answers = answers;
    state.shown += 1;
  };
  const dynamics = new Dynamics(setup, async (data) => {
    if (data.progress !== undefined) {
      find('pace').textContent =
        `Simulating: ${Math.round(100 * data.progress)} % after ${dynamics.waited.toFixed(1)} s`;
      return;
    }
    find('problem').hidden = !data.problem;
    find('problem').textContent = data.problem ?? '';
    if (data.problem) find('pace').textContent = '';
    if (data.answers) await show(data);
    state.isBusy = data.isBroken === true;
    if (state.isStale) ask();
  });
  readHash();
  window.limberPlay = { controls, frames, state, dynamics };  // for tests, and consoles
}

start().catch((error) => {
  find('problem').hidden = false;
  find('problem').textContent = `This page cannot be shown: ${error.message}`;
  console.error(error);
});
