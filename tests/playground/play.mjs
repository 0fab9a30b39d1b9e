// Runs a scene in the playground's module under node, and keeps its results:
// play.mjs MODULE_FOLDER SCENARIO RESULTS [PATH=VALUE...] -- [LINK=BODY...] FILE...
// FILES go into the module's file system under their own paths; BODY is one of them.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, resolve } from 'node:path';

const [folder, scenario, results, ...rest] = process.argv.slice(2);
const split = rest.indexOf('--');
const settings = rest.slice(0, split);
const bodies = rest.slice(split + 1).filter((item) => item.includes('='));
const files = rest.slice(split + 1).filter((item) => !item.includes('='));
const create = createRequire(import.meta.url)(resolve(folder, 'playground.js'));
const module = await create({ wasmBinary: await readFile(resolve(folder, 'playground.wasm')) });

for (const file of [scenario, ...files]) {
  module.FS.mkdirTree(dirname(resolve(file)));
  module.FS.writeFile(resolve(file), await readFile(file));
}
for (const body of bodies) {
  const [link, file] = body.split('=');
  module.ccall('limber_give_body', null, ['string', 'string'], [link, resolve(file)]);
}
const status = module.ccall(
  'limber_play', 'number', ['string', 'string', 'string'],
  [resolve(scenario), settings.join('\n'), '']);
const answer = module.UTF8ToString(module._limber_answer());
if (status !== 0) {
  console.error(`error: ${answer}`);
  process.exit(status);
}
await writeFile(results, module.FS.readFile('/results.h5'));
const { energy, ...summary } = JSON.parse(answer);
console.log(JSON.stringify(summary));
