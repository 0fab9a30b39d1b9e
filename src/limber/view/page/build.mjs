// Bundles the page into one file, and that of playgrounds, play.html, beside it:
// node build.mjs OUTPUT
import { build } from 'esbuild';
import { readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';

const output = process.argv[2] ?? 'view.html';

async function bundle(entry) {
  const result = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    legalComments: 'inline',
    write: false,
    logLevel: 'warning',
  });
  return result.outputFiles[0].text;
}

async function makePage(frame, entry, sheet, file) {
  const script = (await bundle(entry)).replaceAll('</script', '<\\/script');
  const style = await bundle(sheet);
  const page = (await readFile(frame, 'utf8'))
    .replace('/* STYLE-HERE */', () => style)
    .replace('/* SCRIPT-HERE */', () => script);
  await writeFile(file, page);
}

await makePage('index.html', 'main.js', 'style.css', output);
await makePage('play.html', 'play.js', 'play.css', join(dirname(output), 'play.html'));
