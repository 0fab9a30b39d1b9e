// Runs what a page of `limber view --play` holds under node, and keeps the results:
// play.mjs SETUP.json RESULTS [PATH=VALUE...]
// SETUP.json is the page's data (src/limber/view/play_page.cpp); the page itself does the same
// in a worker.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, resolve } from 'node:path';

const [file, results, ...settings] = process.argv.slice(2);
const setup = JSON.parse(await readFile(file, 'utf8'));
const glue = resolve(`${file}.glue.cjs`);
await writeFile(glue, setup.glue);
const create = createRequire(import.meta.url)(glue);
const module = await create({ wasmBinary: Buffer.from(setup.module, 'base64') });

for (const [name, content] of Object.entries(setup.files)) {
  module.FS.mkdirTree(dirname(name));
  module.FS.writeFile(name, Buffer.from(content, 'base64'));
}
for (const [link, body] of Object.entries(setup.bodies)) {
  module.ccall('limber_give_body', null, ['string', 'string'], [link, body]);
}
const status = module.ccall(
  'limber_play', 'number', ['string', 'string'],
  [setup.scenario, [...setup.settings, ...settings].join('\n')]);
const answer = module.UTF8ToString(module._limber_answer());
if (status !== 0) {
  console.error(`error: ${answer}`);
  process.exit(status);
}
await writeFile(results, module.FS.readFile('/results.h5'));
const { energy, ...summary } = JSON.parse(answer);
if (module._limber_show() !== 0) {
  console.error(`error: ${module.UTF8ToString(module._limber_answer())}`);
  process.exit(1);
}
console.log(JSON.stringify({ ...summary, outputs: energy.length, picture: module._limber_size() }));
