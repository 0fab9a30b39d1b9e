// Opens a page of `limber view --play` in headless Chromium, without a network, and uses it:
// drive_play.mjs NODE_MODULES PAGE SUMMARY CHROMIUM FOLDER
// SUMMARY is the summary.json of `limber run` with the page's settings.
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { strict as assert } from 'node:assert';

const [modules, page, summaryFile, chromium, folder] = process.argv.slice(2);
const { chromium: playwright } = createRequire(`${modules}/`)('playwright-core');

const kFlags = [
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox',
  '--disable-background-networking',
];
const kPatience = { timeout: 120000 };
const kLeastMotion = 1e-3;  // of some point of a surface [m]
const kMostGap = 1000;  // in which the page does nothing [ms]

const problems = [];

async function open(browser, size, scheme, hash = '') {
  const context = await browser.newContext({ viewport: size, offline: true, colorScheme: scheme });
  const tab = await context.newPage();
  tab.on('console', (message) => {
    if (message.type() === 'error') problems.push(message.text());
  });
  tab.on('pageerror', (error) => problems.push(String(error)));
  await tab.goto(`file://${page}${hash}`);
  await wait(tab, 1);
  return tab;
}

// For a number of answers, and that there is nothing more to do.
async function wait(tab, shown) {
  await tab.waitForFunction((count) => {
    const { state } = window.limberPlay ?? { state: {} };
    return state.shown >= count && !state.isBusy && !state.isStale;
  }, shown, kPatience);
}

const readState = (tab) => tab.evaluate(() => {
  const { shown, levels, answers } = window.limberPlay.state;
  return { shown, levels, answers };
});

// The answer without what a clock says.
const describe = ({ answers }) => JSON.stringify(
  answers.map(({ simulated, steps, modes, energy }) => [simulated, steps, modes, energy]));

const readPeaks = (tab) => tab.evaluate(() => Object.fromEntries(
  window.limberPlay.frames.current.contentWindow.limber.results[0].probes
    .filter((probe) => probe.peak).map(({ name, peak }) => [name, peak.value])));

// Peaks are those of the command; the last bit of sines may differ.
async function comparePeaks(tab) {
  const { probes } = JSON.parse(await readFile(summaryFile, 'utf8'));
  const found = await readPeaks(tab);
  assert.ok(Object.keys(found).length > 0, 'the page has no probes');
  for (const [name, value] of Object.entries(found)) {
    const wanted = probes[name].peak;
    assert.ok(Math.abs(value - wanted) <= 1e-6 * Math.abs(wanted), `${name}: ${value}, not ${wanted}`);
  }
}

async function checkMotion(tab) {
  const moved = await tab.evaluate(() => {
    const { view, player, results } = window.limberPlay.frames.current.contentWindow.limber;
    const { motion } = view;
    let most = 0;
    motion.result.bodies.forEach((body, b) => {
      if (body.surface === undefined || body.surface < 0) return;
      const from = motion.position(b, 0, player.start);
      const to = motion.position(b, 0, player.end);
      most = Math.max(most, Math.hypot(...to.map((x, c) => x - from[c])));
    });
    return { most, isPlaying: player.isPlaying, results: results.length };
  });
  assert.ok(moved.most > kLeastMotion, `nothing moves by more than ${moved.most} m`);
  assert.ok(moved.isPlaying, 'the page does not play');
  const { levels } = await readState(tab);
  assert.equal(moved.results, levels.length, 'the rigid ghost is beside the flexible arm');
}

const move = (tab, path, value) => tab.evaluate(([name, wish]) => {
  const input = document.querySelector(`[name="${CSS.escape(name)}"]`);
  input.value = wish;
  input.dispatchEvent(new Event(input.tagName === 'SELECT' ? 'change' : 'input', { bubbles: true }));
}, [path, value]);

// Every slider and choice changes the answer, and a reset takes it back.
async function checkControls(tab) {
  const list = await tab.evaluate(() => window.limberPlay.controls.rows.map(({ control }) => control));
  const given = describe(await readState(tab));
  for (const { path, value, min, max, choices } of list) {
    const wish = choices?.find((choice) => choice !== value && choice !== 'rigid')
      ?? (value - min > max - value ? value - 0.3 * (value - min) : value + 0.3 * (max - value));
    let { shown } = await readState(tab);
    await move(tab, path, wish);
    await wait(tab, shown + 1);
    const problem = await tab.textContent('#problem');
    assert.equal(problem, '', `${path} = ${wish}: ${problem}`);
    assert.notEqual(describe(await readState(tab)), given, `${path} = ${wish} changes nothing`);
    ({ shown } = await readState(tab));
    await tab.click('#reset');
    await wait(tab, shown + 1);
    assert.equal(describe(await readState(tab)), given, `${path} is not taken back`);
  }
  return list;
}

// The address holds the settings, and refuses what it must.
async function checkLink(browser, tab, size, list) {
  const slider = list.find(({ choices }) => !choices);
  const { shown } = await readState(tab);
  await move(tab, slider.path, 0.5 * (slider.value + slider.max));
  await wait(tab, shown + 1);
  const hash = new URL(tab.url()).hash;
  assert.ok(hash.startsWith(`#${slider.path}=`), `the address ends with ${hash}`);
  const other = await open(browser, size, 'light', hash);
  assert.equal(describe(await readState(other)), describe(await readState(tab)), 'a link gives the same');
  assert.equal(await other.textContent('#refused'), '');
  await other.close();
  const bad = await open(
    browser, size, 'light', `#${slider.path}=1e30&nothing=1&step%20=2&${list[1].path}=many`);
  const refused = await bad.locator('#refused li').allTextContents();
  assert.equal(refused.length, 4, refused.join('\n'));
  assert.match(refused[0], /which is taken/);
  assert.match(refused[1], /no such value/);
  assert.match(refused[3], /no number|choices/);
  await bad.close();
}

// While the worker is busy the page goes on, and a change ends a run that takes long.
async function checkIsFree(tab) {
  const gap = await tab.evaluate(async () => {
    const { state, dynamics } = window.limberPlay;
    let last = performance.now();
    let most = 0;
    const tick = setInterval(() => {
      const now = performance.now();
      most = Math.max(most, now - last);
      last = now;
    }, 10);
    const { settings } = dynamics.setup;
    dynamics.setup.settings = [...settings, 'steps=0.02'];
    const shown = state.shown;
    document.getElementById('reset').click();
    await new Promise((done) => setTimeout(done, 2500));
    const wasBusy = state.isBusy && state.shown === shown;
    const progress = document.getElementById('pace').textContent;
    const quiet = most;
    clearInterval(tick);
    dynamics.setup.settings = settings;
    document.getElementById('reset').click();
    return { quiet, wasBusy, progress, shown };
  });
  assert.ok(gap.wasBusy, 'the long run was short');
  assert.match(gap.progress, /^Simulating: \d+ %/);
  assert.ok(gap.quiet < kMostGap, `the page stood still for ${gap.quiet} ms`);
  await wait(tab, gap.shown + 1);
}

async function main() {
  const browser = await playwright.launch({ executablePath: chromium, args: kFlags });
  const wide = { width: 1280, height: 800 };
  const tab = await open(browser, wide, 'light');
  console.log(await tab.textContent('#pace'));
  await comparePeaks(tab);
  await checkMotion(tab);
  await tab.screenshot({ path: `${folder}/wide_light.png` });
  const list = await checkControls(tab);
  console.log(`warm: ${await tab.textContent('#pace')}`);
  await checkLink(browser, tab, wide, list);
  await checkIsFree(tab);
  await tab.close();
  for (const [name, size, scheme] of [
    ['wide_dark', wide, 'dark'], ['narrow_light', { width: 390, height: 844 }, 'light'],
    ['narrow_dark', { width: 390, height: 844 }, 'dark']]) {
    const one = await open(browser, size, scheme);
    await one.screenshot({ path: `${folder}/${name}.png` });
    const { over } = await one.evaluate(() => ({
      over: document.documentElement.scrollWidth - innerWidth }));
    assert.ok(over <= 0, `${name}: ${over} pixels too wide`);
    await one.close();
  }
  await browser.close();
  assert.deepEqual(problems, [], 'errors in the console');
  console.log(`${list.length} controls`);
}

await main();
