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
    assert.deepEqual(problems, [], 'the page reports errors');
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
