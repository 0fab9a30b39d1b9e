// Pages of one arm near the origin, far away and fast, in headless Chromium: all
// show the same: drive_far.mjs NODE_MODULES CHROMIUM FOLDER
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { strict as assert } from 'node:assert';

const [modules, chromium, folder] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { chromium: playwright } = require('playwright-core');

const kFlags = [
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox',
  '--disable-background-networking',
];
const kTime = 0.155; // between outputs [s]

async function open(browser, name, problems) {
  const context = await browser.newContext({
    viewport: { width: 1200, height: 700 }, offline: true });
  const tab = await context.newPage();
  tab.on('console', (m) => m.type() === 'error' && problems.push(m.text()));
  tab.on('pageerror', (error) => problems.push(String(error)));
  await tab.goto(`file://${folder}/${name}.html#t=${kTime}&field=deformation`);
  await tab.waitForFunction(() => window.limber?.view.isStale === false, null, { timeout: 60000 });
  await tab.screenshot({ path: `${folder}/page-${name}.png` });
  return tab;
}

// The page's own motion against that of the library. Positions of doubles are
// rounded themselves.
async function comparePoints(tab, name) {
  const points = JSON.parse(await readFile(`${folder}/${name}.json`, 'utf8'));
  const found = await tab.evaluate((list) => {
    const { motion } = window.limber.view;
    const { bodies } = motion.result;
    return list.map(({ time, body, node }) => {
      const b = bodies.findIndex((one) => one.name === body);
      return { position: motion.position(b, node, time), error: bodies[b].error };
    });
  }, points);
  points.forEach(({ position, node }, i) => {
    const error = Math.hypot(...position.map((value, c) => value - found[i].position[c]));
    const rounding = 2 ** -51 * Math.hypot(...position);
    assert.ok(error <= found[i].error + rounding, `${name}, node ${node}: off by ${error} m`);
  });
}

// Pixels of the canvas, and where bodies and marks are for the camera.
const readScene = (tab) => tab.evaluate(() => {
  const { view } = window.limber;
  view.draw();
  const gl = view.renderer.getContext();
  const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE,
    pixels);
  const placeOf = ({ matrixWorld }) => Array.from(matrixWorld.elements.slice(12, 15));
  return {
    pixels: Array.from(pixels),
    bodies: view.bodies.links.map(({ group }) => placeOf(group)),
    ghosts: view.ghosts.flatMap(({ links }) => links.map(({ group }) => placeOf(group))),
    about: document.getElementById('panel').textContent,
  };
});

function shareOfDifferent(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    if ([0, 1, 2].some((c) => Math.abs(a[i + c] - b[i + c]) > 8)) ++count;
  }
  return count / (a.length / 4);
}

async function main() {
  const browser = await playwright.launch({ executablePath: chromium, args: kFlags });
  const problems = [];
  try {
    const scenes = {};
    for (const name of ['near', 'map', 'far', 'fast', 'ghost']) {
      const tab = await open(browser, name, problems);
      if (name !== 'ghost') await comparePoints(tab, name);
      scenes[name] = await readScene(tab);
      await tab.context().close();
    }
    const { near, map, far, fast, ghost } = scenes;
    assert.ok(new Set(near.pixels).size > 20, 'the picture is blank');
    // At 1e7 m positions are rounded to 1.9e-9 m, and Newton's corrections end in that noise:
    // the motion itself differs by 1e-6 to 7e-6 m there, from machine to machine otherwise.
    for (const [other, allowed] of [[map, 1e-6], [far, 1e-5]]) {
      assert.ok(shareOfDifferent(near.pixels, other.pixels) < 0.01, 'it looks different far away');
      near.bodies.forEach((place, b) => place.forEach((value, c) => {
        const gap = value - other.bodies[b][c];
        assert.ok(Math.abs(gap) < allowed, `body ${b} is elsewhere by ${gap} m`);
      }));
    }
    assert.match(far.about, /positions count from \(10000000, 0, 0\) m/);
    assert.doesNotMatch(near.about, /positions count from/);
    assert.match(fast.about, /the picture moves with the mean/);
    // Fast: relative to each other the bodies are where they are near the origin.
    near.bodies.forEach((place, b) => place.forEach((value, c) => {
      const expected = value - near.bodies[0][c];
      const found = fast.bodies[b][c] - fast.bodies[0][c];
      assert.ok(Math.abs(found - expected) < 1e-5, `fast: a body is off by ${found - expected} m`);
    }));
    far.bodies.forEach((place, b) => {
      const gap = ghost.ghosts[b].map((value, c) => value - ghost.bodies[b][c]);
      assert.ok(Math.hypot(gap[0], gap[1] - 0.05, gap[2]) < 1e-5, `the ghost is at ${gap} m`);
    });
    assert.deepEqual(problems, [], 'the page reports errors');
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
