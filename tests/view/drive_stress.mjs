// Stress in a page in headless Chromium, against the recorded largest of the
// library: drive_stress.mjs NODE_MODULES PAGE CHROMIUM FOLDER
import { createRequire } from 'node:module';
import { strict as assert } from 'node:assert';

const [modules, page, chromium, folder] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { chromium: playwright } = require('playwright-core');

const kFlags = [
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox',
  '--disable-background-networking',
];
const kField = 4;

async function compareLargest(tab) {
  const gaps = await tab.evaluate((field) => {
    const { view, player } = window.limber;
    view.setField(field);
    const { result, times } = view.motion;
    const recorded = result.probes.find(({ name }) => name.endsWith('.surface.von_mises')).values;
    const most = Math.max(...recorded);
    return Array.from(times, (t, i) => {
      player.seek(t);
      view.draw();
      return Math.abs(view.bodies.largestStress - recorded[i]) / most;
    });
  }, kField);
  const worst = Math.max(...gaps);
  assert.ok(worst < 1e-3, `the largest stress is off by ${worst} of the largest of the run`);
  return { worst, count: gaps.length };
}

// A click on the surface offers a plot of the stress there; what it draws is
// compared with the probe of the library at the node of that probe.
async function comparePicked(tab) {
  const place = await tab.evaluate(() => {
    const { view, player } = window.limber;
    view.setMagnification(1);
    player.seek(player.start);
    view.draw();
    const eye = view.camera.eye;
    const { motion } = view;
    const nodes = motion.result.surfaces[motion.result.bodies[0].surface].nodes;
    const box = document.getElementById('canvas').getBoundingClientRect();
    for (let node = 0; node < nodes; ++node) {
      const at = motion.position(0, node, player.time);
      const screen = eye.position.clone().set(...at).project(eye);
      // A click is on a whole pixel: not at the edge of what is seen.
      const around = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]].map(([dx, dy]) =>
        window.limber.pickAt(screen.x + (2 * dx) / box.width, screen.y + (2 * dy) / box.height));
      if (around.some((hit) => hit?.node !== node)) continue;
      return { x: box.left + ((screen.x + 1) / 2) * box.width,
        y: box.top + ((1 - screen.y) / 2) * box.height };
    }
    return null;
  });
  assert.ok(place, 'no node can be picked');
  await tab.mouse.click(place.x, place.y);
  await tab.locator('#picked button', { hasText: 'stress' }).click();
  await tab.screenshot({ path: `${folder}/picked.png` });
  const { shown, gap } = await tab.evaluate(() => {
    const { view, traceStress } = window.limber;
    const { result, times } = view.motion;
    const names = ['xx', 'yy', 'zz', 'xy', 'yz', 'xz'];
    const probes = names.map((c) => result.probes.find(({ name }) => name === `middle.s${c}`).values);
    const { nodes } = result.surfaces[result.bodies[0].surface];
    let nearest = 0;
    let least = Infinity;
    for (let n = 0; n < nodes; ++n) {
      // The link's frame is that of the world at the start.
      const [x, y, z] = view.motion.position(0, n, times[0]);
      const far = Math.hypot(x, y - 0.5, z - 2.5);
      if (far < least) [nearest, least] = [n, far];
    }
    const { series } = traceStress(view.motion, 0, nearest);
    const most = Math.max(...probes[2].map(Math.abs));
    const gaps = names.flatMap((c, k) => {
      const { values } = series.find(({ label }) => label === c);
      return Array.from(times, (t, i) => Math.abs(values[i] - probes[k][i]) / most);
    });
    return { shown: view.plots.shown.at(-1).group, gap: Math.max(...gaps) };
  });
  assert.match(shown.name, /, node \d+$/);
  assert.equal(shown.unit, 'Pa');
  assert.equal(shown.series.length, 7);
  assert.ok(gap < 1e-3, `stress over time is off by ${gap} of its largest at the probe`);
  return gap;
}

async function main() {
  const browser = await playwright.launch({ executablePath: chromium, args: kFlags });
  const problems = [];
  try {
    const context = await browser.newContext({
      viewport: { width: 1440, height: 900 }, offline: true });
    const tab = await context.newPage();
    tab.on('console', (m) => m.type() === 'error' && problems.push(m.text()));
    tab.on('pageerror', (error) => problems.push(String(error)));
    await tab.goto(`file://${page}#peak&field=von_mises&magnification=100000`);
    await tab.waitForFunction(() => window.limber?.view.isStale === false, null, { timeout: 60000 });
    await tab.waitForTimeout(300);
    await tab.screenshot({ path: `${folder}/stress.png` });
    const legend = await tab.locator('.legend-title').textContent();
    assert.equal(legend, 'von Mises stress');
    assert.match(await tab.locator('.legend-ticks').textContent(), /Pa/);
    const colours = await tab.evaluate(() => {
      const gl = window.limber.view.renderer.getContext();
      window.limber.view.draw();
      const all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA,
        gl.UNSIGNED_BYTE, all);
      const seen = new Set();
      for (let i = 0; i < all.length; i += 64) seen.add(`${all[i]},${all[i + 1]},${all[i + 2]}`);
      return seen.size;
    });
    assert.ok(colours > 50, `the surface has ${colours} colours`);
    const { worst, count } = await compareLargest(tab);
    const gap = await comparePicked(tab);
    assert.deepEqual(problems, [], 'the page reports errors');
    console.log(`stress of a picked node within ${gap.toExponential(2)} of the probe's largest`);
    console.log(`largest stress at ${count} outputs within ${worst.toExponential(2)} of the largest`);
  } catch (error) {
    console.error(problems.slice(0, 5).join('\n'));
    throw error;
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
