// Opens a page in headless Chromium and uses it: drive_page.mjs
// NODE_MODULES PAGE POINTS CHROMIUM FOLDER
import { createRequire } from 'node:module';
import { readFile, stat } from 'node:fs/promises';
import { strict as assert } from 'node:assert';

const [modules, page, pointsFile, chromium, folder] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { chromium: playwright } = require('playwright-core');

const kMostBytes = 10e6;
const kFlags = [
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-sandbox',
  '--disable-background-networking',
];

async function open(browser, file, size, problems) {
  const context = await browser.newContext({ viewport: size, offline: true });
  const tab = await context.newPage();
  tab.on('console', (message) => {
    if (message.type() === 'error') problems.push(message.text());
  });
  tab.on('pageerror', (error) => problems.push(String(error)));
  await tab.goto(`file://${file}`);
  await tab.waitForFunction(() => window.limber?.view.isStale === false, null, { timeout: 60000 });
  return tab;
}

// The page's own motion against that of the library.
async function comparePoints(tab) {
  const points = JSON.parse(await readFile(pointsFile, 'utf8'));
  const found = await tab.evaluate((list) => {
    const { motion } = window.limber.view;
    const bodies = motion.result.bodies;
    return list.map(({ time, body, node }) => {
      const b = bodies.findIndex((one) => one.name === body);
      const { x } = motion.result.surfaces[bodies[b].surface];
      const size = Math.max(
        ...[0, 1, 2].map((c) => {
          const along = x.filter((_, i) => i % 3 === c);
          return Math.max(...along) - Math.min(...along);
        }));
      return { position: motion.position(b, node, time), error: bodies[b].error, size };
    });
  }, points);
  let worst = 0;
  let stated = 0;
  points.forEach(({ position, body, node, time }, i) => {
    const error = Math.hypot(...position.map((value, c) => value - found[i].position[c]));
    assert.ok(
      error <= found[i].error,
      `node ${node} of ${body} at ${time} s is off by ${error} m, stated ${found[i].error} m`);
    assert.ok(found[i].error < 1e-4 * found[i].size, `the stated error of ${body} is large`);
    worst = Math.max(worst, error);
    stated = Math.max(stated, found[i].error);
  });
  return { worst, stated, count: points.length };
}

// What the page calls the largest, and its moment, over all nodes and outputs.
async function compareLargest(tab) {
  const { deformation, time, velocity } =
    JSON.parse(await readFile(`${folder}/largest.json`, 'utf8'));
  const [, most, , fastest, peak] = await tab.evaluate(() => {
    const { most: all, peak: at } = window.limber.view.ranges;
    return [...all.slice(0, 4), at];
  });
  assert.ok(Math.abs(most / deformation - 1) < 1e-6, `deformation ${most} m, not ${deformation}`);
  assert.ok(fastest / velocity > 1 - 1e-6, `velocity ${fastest} m/s, less than ${velocity}`);
  assert.equal(peak, time, 'the moment of the largest deformation');
}

// Plots reach to the peaks of all steps, which summary.json has.
async function comparePeaks(tab) {
  const { probes } = JSON.parse(await readFile(`${folder}/run/summary.json`, 'utf8'));
  const found = await tab.evaluate(() => window.limber.results[0].probes.map(
    ({ name, peak }) => ({ name, ...peak })));
  assert.ok(found.length > 0, 'the page has no probes');
  for (const { name, value, time } of found) {
    assert.equal(value, probes[name].peak, `peak of ${name}`);
    assert.equal(time, probes[name].peak_time, `time of the peak of ${name}`);
  }
  const missed = await tab.evaluate(async () => {
    const { view } = window.limber;
    view.probeGroups.forEach((group) => view.plots.has(group) || view.plots.add(group));
    await new Promise((done) => setTimeout(done, 100)); // plots find their scales later
    const out = view.plots.shown.flatMap(({ group, plot }) => group.series.filter(
      ({ peak }) => !(plot.scales.y.min <= peak.value && peak.value <= plot.scales.y.max)));
    view.probeGroups.forEach((group) => view.plots.remove(group));
    return out.map(({ label }) => label);
  });
  assert.deepEqual(missed, [], 'peaks outside of their plots');
}

// By mouse, as users move it.
async function checkSlider(tab) {
  const box = await tab.locator('#slider').boundingBox();
  const y = box.y + box.height / 2;
  const share = () => tab.evaluate(() => window.limber.player.time / window.limber.player.end);
  await tab.mouse.click(box.x + 0.25 * box.width, y);
  assert.ok(Math.abs((await share()) - 0.25) < 0.02, `a click on the slider goes to ${await share()}`);
  await tab.mouse.down();
  await tab.mouse.move(box.x + 0.75 * box.width, y, { steps: 5 });
  await tab.mouse.up();
  assert.ok(Math.abs((await share()) - 0.75) < 0.02, `the slider drags to ${await share()}`);
}

// Names of links, moved towards the legend, and the legend itself.
async function checkLabels(tab) {
  await tab.evaluate(() => {
    const { view } = window.limber;
    view.setField(1);
    view.names.toggle();
  });
  let shown = 0;
  for (const [x, y] of [[0, 0], [200, 60], [360, 150], [420, 260]]) {
    const boxes = await tab.evaluate(([right, down]) => {
      const { view } = window.limber;
      const { clientWidth: w, clientHeight: h } = view.elements.stage;
      view.camera.eye.setViewOffset(w, h, right, down, w, h);
      view.draw();
      view.camera.eye.clearViewOffset();
      const labels = [...document.querySelectorAll('#names span')].filter(
        (label) => label.style.visibility === 'visible');
      return [document.getElementById('legend'), ...labels].map((label) => {
        const { left, right: r, top, bottom } = label.getBoundingClientRect();
        return { left, right: r, top, bottom };
      });
    }, [x, y]);
    shown += boxes.length - 1;
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => assert.ok(
      a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top,
      `labels overlap, the picture moved by ${x}, ${y}`)));
  }
  assert.ok(shown > 10, `${shown} names are shown`);
  await tab.evaluate(() => {
    const { view } = window.limber;
    view.names.toggle();
    view.setField(0);
  });
}

// Colours of the canvas as drawn now, on a coarse grid.
const readPixels = (tab) =>
  tab.evaluate(() => {
    const { view } = window.limber;
    view.draw();
    const gl = view.renderer.getContext();
    const w = gl.drawingBufferWidth;
    const h = gl.drawingBufferHeight;
    const all = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
    const grid = [];
    for (let y = 2; y < h; y += 4) {
      for (let x = 2; x < w; x += 4) {
        const at = 4 * (y * w + x);
        grid.push((all[at] << 16) | (all[at + 1] << 8) | all[at + 2]);
      }
    }
    return grid;
  });

const countDifferent = (a, b) => a.filter((value, i) => value !== b[i]).length;

// Surfaces deformed by the processor, as here, and by shaders, as elsewhere, are one
// picture, in every field.
async function checkDeformers(tab) {
  await tab.evaluate(() => {
    window.limber.player.seek(window.limber.view.ranges.peak);
    window.limber.view.setMagnification(300);
    window.limber.view.setDetail(false);
  });
  for (const field of [0, 1, 2, 3]) {
    await tab.evaluate((f) => {
      window.limber.view.setField(f);
      window.limber.view.setProcessor(true);
    }, field);
    const first = await readPixels(tab);
    await tab.evaluate(() => window.limber.view.setProcessor(false));
    const different = countDifferent(first, await readPixels(tab));
    assert.ok(different < 1e-3 * first.length, `field ${field}: ${different} pixels differ`);
  }
  // Triangles smaller than pixels, with and without their mid-side nodes.
  await tab.evaluate(() => {
    window.limber.view.setProcessor(true);
    window.limber.view.setField(0);
  });
  const fine = await readPixels(tab);
  await tab.evaluate(() => window.limber.view.setDetail(true));
  const different = countDifferent(fine, await readPixels(tab));
  assert.ok(different < 0.01 * fine.length, `fewer triangles change ${different} pixels`);
  await tab.evaluate(() => {
    window.limber.view.setMagnification(1);
  });
}

// What the shader draws, by a point picked where the twin says a node is.
async function checkPicking(tab) {
  const misses = await tab.evaluate(() => {
    const { view, player, pickAt } = window.limber;
    const { motion } = view;
    player.seek(view.ranges.peak);
    view.draw();
    let tried = 0;
    let near = 0;
    motion.result.bodies.forEach((body, b) => {
      if (body.surface < 0) return;
      const surface = motion.result.surfaces[body.surface];
      for (let k = 0; k < 4; ++k) {
        const node = Math.floor((surface.nodes * (k + 0.5)) / 4);
        const place = motion.position(b, node, player.time);
        const eye = view.camera.eye;
        const screen = eye.position.clone().set(...place).project(eye);
        const hit = pickAt(screen.x, screen.y);
        if (!hit || hit.body !== b) continue; // behind another, or at an edge
        ++tried;
        const gap = Math.hypot(...hit.point.map((value, c) => value - place[c]));
        const far = eye.position.distanceTo(eye.position.clone().set(...place));
        const nearer = eye.position.distanceTo(eye.position.clone().set(...hit.point)) <= far;
        if (gap < 0.02 * far || nearer) ++near;
      }
    });
    return { tried, near };
  });
  assert.ok(misses.tried > 0, 'no node could be picked');
  assert.equal(misses.near, misses.tried, 'picked points are behind the nodes');
}

// Median time of a frame [ms].
const timeFrames = (tab, hasGhosts) =>
  tab.evaluate((isShown) => {
    const { view, player } = window.limber;
    for (const ghost of view.ghosts) ghost.group.visible = isShown;
    const gl = view.renderer.getContext();
    const pixel = new Uint8Array(4);
    const all = [];
    for (let i = 0; i < 40; ++i) {
      player.seek(player.start + ((player.end - player.start) * i) / 40);
      const start = performance.now();
      view.draw();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      all.push(performance.now() - start);
    }
    return all.sort((a, b) => a - b)[20];
  }, hasGhosts);

async function checkPlay(tab) {
  await tab.evaluate(() => window.limber.player.seek(window.limber.player.start));
  await tab.keyboard.press('Space');
  await tab.waitForFunction(() => window.limber.player.time > window.limber.player.start);
  await tab.keyboard.press('Space');
  const [first, second] = await tab.evaluate(async () => {
    const { player } = window.limber;
    const at = player.time;
    await new Promise((done) => setTimeout(done, 100));
    return [at, player.time];
  });
  assert.equal(first, second, 'it plays on after a pause');
  await tab.evaluate(() => window.limber.player.seek(1e9));
  assert.equal(
    await tab.evaluate(() => window.limber.player.time - window.limber.player.end), 0);
}

// Each control of the panel changes the picture, and its opposite undoes that.
async function checkPanel(tab) {
  await tab.evaluate(() => window.limber.player.seek(window.limber.player.end / 2));
  const before = await readPixels(tab);
  const expectChange = async (what, change, undo) => {
    await tab.evaluate(change);
    assert.ok(countDifferent(before, await readPixels(tab)) > 5, `${what} changes nothing`);
    await tab.evaluate(undo);
    assert.equal(countDifferent(before, await readPixels(tab)), 0, `${what} cannot be undone`);
  };
  await expectChange(
    'hiding ghosts',
    () => (window.limber.view.ghosts[0].group.visible = false),
    () => (window.limber.view.ghosts[0].group.visible = true));
  await expectChange(
    'isolating a link',
    () => window.limber.view.isolate(window.limber.view.bodies.links[1]),
    () => window.limber.view.isolate(window.limber.view.bodies.links[1]));
  await expectChange(
    'a transparent link',
    () => window.limber.view.clearLink(window.limber.view.bodies.links[0]),
    () => window.limber.view.clearLink(window.limber.view.bodies.links[0]));
  await expectChange(
    'hiding a link',
    () => window.limber.view.showLink(window.limber.view.bodies.links[0], false),
    () => window.limber.view.showLink(window.limber.view.bodies.links[0], true));
}

// Rigid links have no deformation; every map has colours of its own.
async function checkColours(tab) {
  const [bare, note] = await tab.evaluate(() => {
    const { view } = window.limber;
    view.setField(1);
    view.draw();
    const grey = view.bodies.moving.filter(({ material }) => material.color.getHex() === 0xb4b8bf);
    return [
      grey.map(({ modes }) => modes), document.getElementById('legend').textContent,
    ];
  });
  assert.ok(bare.length > 0 && bare.every((modes) => modes === 0), `grey: ${bare}`);
  assert.match(note, /grey: .*rigid/);
  const pictures = [];
  for (const map of ['viridis', 'cividis', 'turbo']) {
    await tab.selectOption('#map', map);
    pictures.push(await readPixels(tab));
  }
  assert.ok(countDifferent(pictures[0], pictures[1]) > 20, 'cividis is viridis');
  assert.ok(countDifferent(pictures[0], pictures[2]) > 20, 'turbo is viridis');
  await tab.selectOption('#map', 'viridis');
  assert.equal(countDifferent(pictures[0], await readPixels(tab)), 0);
  await tab.evaluate(() => window.limber.view.setField(0));
}

// Two results side by side, by key, and again in one place.
async function checkBeside(tab) {
  const together = await readPixels(tab);
  await tab.keyboard.press('b');
  assert.ok(countDifferent(together, await readPixels(tab)) > 20, 'nothing is beside');
  const far = await tab.evaluate(() => {
    const { view } = window.limber;
    return view.ghosts[0].group.position.length() / view.box.size;
  });
  assert.ok(far > 0.3, `the other result is ${far} sizes away`);
  await tab.keyboard.press('b');
  assert.equal(countDifferent(together, await readPixels(tab)), 0, 'b cannot be undone');
}

// What the saved picture says; ink where the canvas has none.
async function checkCaption(tab) {
  await tab.evaluate(() => {
    const { view, player } = window.limber;
    view.setField(1);
    view.setMagnification(100);
    player.seek(0.04);
  });
  const { title, lines, legend } = await tab.evaluate(() => {
    window.limber.view.draw();
    return window.limber.makeCaption();
  });
  assert.equal(title, 'struck_finger');
  assert.match(lines[0], /^t = 40 ms, deformation \u00d7 100$/);
  assert.equal(legend.label, 'deformation');
  const [file] = await Promise.all([tab.waitForEvent('download'), tab.keyboard.press('s')]);
  const bytes = (await readFile(await file.path())).toString('base64');
  const ink = await tab.evaluate(async (data) => {
    const blob = await (await fetch(`data:image/png;base64,${data}`)).blob();
    const picture = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0);
    const countInk = (x, y, w, h) => {
      const { data: rgba } = context.getImageData(x, y, w, h);
      return rgba.filter((value, i) => i % 4 === 0 && value < 90).length;
    };
    return [countInk(0, 0, 200, 36), countInk(0, picture.height - 44, 300, 44)];
  }, bytes);
  assert.ok(ink.every((count) => count > 50), `title and time have ${ink} dark pixels`);
  await tab.evaluate(() => {
    window.limber.view.setField(0);
    window.limber.view.setMagnification(1);
  });
}

// By taps, as on a phone: nothing is wider than the screen, the panel is a sheet.
async function checkPhone(browser, problems) {
  const size = { width: 390, height: 844 };
  const context = await browser.newContext({
    viewport: size, offline: true, hasTouch: true, isMobile: true,
  });
  const tab = await context.newPage();
  tab.on('pageerror', (error) => problems.push(String(error)));
  await tab.goto(`file://${page}#plots&field=deformation`);
  await tab.waitForFunction(() => window.limber?.view.isStale === false, null, { timeout: 60000 });
  const wide = await tab.evaluate(
    () => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.equal(wide, 0, 'on a phone the page is wider than the screen');
  const boxOf = (id) => tab.locator(id).boundingBox();
  assert.equal(await boxOf('#panel'), null, 'the panel covers the picture');
  const [canvas, plots, play] = [await boxOf('#canvas'), await boxOf('#plot-area'), await boxOf('#play')];
  assert.ok(canvas.width === size.width && canvas.height > 200, `the canvas has ${canvas.height}`);
  assert.ok(plots.y >= canvas.y + canvas.height - 1, 'plots are not below the picture');
  assert.ok(play.y > 0.75 * size.height && play.height >= 40, 'play is out of reach');
  await tab.tap('#panel-button');
  const sheet = await boxOf('#panel');
  assert.ok(sheet.y > 0.3 * size.height && sheet.y + sheet.height <= size.height + 1);
  await shoot(tab, 'phone');
  await tab.tap('#panel-button');
  assert.equal(await boxOf('#panel'), null);
  await tab.tap('#play');
  assert.ok(await tab.evaluate(() => window.limber.player.isPlaying), 'a tap does not play');
  await context.close();
}

// A load's arrow lives as long as the load: 10 ms.
async function checkArrow(tab) {
  const lives = await tab.evaluate(() => {
    const { player, view } = window.limber;
    return [0.005, 0.0099, 0.0101, 1].map((t) => {
      player.seek(t);
      view.draw();
      return view.marks.forces[0].force.visible;
    });
  });
  assert.deepEqual(lives, [true, true, false, false]);
}

async function download(tab, key, header) {
  const [file] = await Promise.all([
    tab.waitForEvent('download', { timeout: 240000 }).catch(async (error) => {
      throw new Error(`${key}: ${await tab.textContent('#note')} ${error.message}`);
    }),
    tab.keyboard.press(key),
  ]);
  const bytes = await readFile(await file.path());
  assert.ok(bytes.length > 5000, `${file.suggestedFilename()} has ${bytes.length} bytes`);
  assert.equal(bytes.subarray(0, 4).toString('hex'), header, file.suggestedFilename());
}

async function checkFiles(tab) {
  await download(tab, 's', '89504e47');
  await tab.evaluate(() => {
    const { player } = window.limber;
    player.setSpeed(0.2);  // slow enough for frames on a busy machine
    player.setInterval(0.2, 0.8);
  });
  await download(tab, 'r', '1a45dfa3');
  await tab.evaluate(() => {
    const { player } = window.limber;
    player.setSpeed(1);
    player.setInterval(player.start, player.end);
  });
}

// A picked node is plotted, and a click in the plot goes to its time.
async function checkPlots(tab) {
  await tab.keyboard.press('p');
  const plot = tab.locator('.plot .u-over').first();
  const box = await plot.boundingBox();
  await tab.mouse.click(box.x + 0.25 * box.width, box.y + 0.5 * box.height);
  const share = await tab.evaluate(() => window.limber.player.time / window.limber.player.end);
  assert.ok(Math.abs(share - 0.25) < 0.02, `a click in a plot goes to ${share}`);
  await tab.keyboard.press('p');
  assert.equal(await tab.locator('.plot').count(), 0);
}

async function shoot(tab, name) {
  await tab.waitForTimeout(300);
  await tab.screenshot({ path: `${folder}/${name}.png` });
}

async function takeViews(browser, problems) {
  for (const [size, name] of [
    [{ width: 1280, height: 720 }, '1280x720'],
    [{ width: 2560, height: 1440 }, '2560x1440'],
  ]) {
    const tab = await open(browser, `${page}#plots`, size, problems);
    await shoot(tab, `plots-${name}`);
    const wide = await tab.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.equal(wide, 0, `at ${name} the page is wider than the window`);
    await tab.context().close();
  }
  const dark = await open(
    browser, `${page}#dark&peak&magnification=300&field=deformation`, { width: 1440, height: 900 },
    problems);
  await dark.keyboard.press('n');
  await shoot(dark, 'dark-magnified');
  assert.ok(await dark.evaluate(() => window.limber.player.time > 0), '#peak is not the start');
  await dark.context().close();
}

async function main() {
  const { size } = await stat(page);
  assert.ok(size < kMostBytes, `the page has ${size} bytes`);
  const browser = await playwright.launch({ executablePath: chromium, args: kFlags });
  const problems = [];
  try {
    const tab = await open(browser, page, { width: 1440, height: 900 }, problems);
    await shoot(tab, 'default');
    const { worst, stated, count } = await comparePoints(tab);
    await compareLargest(tab);
    await comparePeaks(tab);
    const start = await readPixels(tab);
    assert.ok(new Set(start).size > 20, 'the picture is blank');
    await tab.evaluate(() => window.limber.player.seek(window.limber.player.end));
    const end = await readPixels(tab);
    assert.ok(countDifferent(start, end) > 20, 'nothing moves');
    await tab.evaluate(() => window.limber.view.setMagnification(1000));
    assert.ok(countDifferent(end, await readPixels(tab)) > 20, 'nothing is magnified');
    await tab.evaluate(() => window.limber.view.setMagnification(1));
    for (const field of [1, 2, 3]) {
      await tab.evaluate((f) => window.limber.view.setField(f), field);
      assert.ok(countDifferent(end, await readPixels(tab)) > 20, `field ${field} has no colours`);
    }
    await shoot(tab, 'velocity');
    await tab.evaluate(() => window.limber.view.setField(0));
    assert.ok(await tab.evaluate(() => window.limber.view.isProcessor), 'SwiftShader is not told');
    await checkDeformers(tab);
    await checkPicking(tab);
    await checkPanel(tab);
    await checkColours(tab);
    await checkBeside(tab);
    await checkCaption(tab);
    await checkSlider(tab);
    await checkLabels(tab);
    await checkArrow(tab);
    await checkPlots(tab);
    await checkFiles(tab);
    await checkPlay(tab);
    await tab.setViewportSize({ width: 1280, height: 720 });
    const alone = await timeFrames(tab, false);
    const both = await timeFrames(tab, true);
    await takeViews(browser, problems);
    await checkPhone(browser, problems);
    assert.deepEqual(problems, [], 'the page reports errors');
    console.log(
      `${count} positions within ${worst.toExponential(2)} m (stated ${stated.toExponential(2)} m); ` +
        `${(size / 1e6).toFixed(2)} MB; ${alone.toFixed(1)} ms a frame, ` +
        `${both.toFixed(1)} ms with the ghost`);
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
