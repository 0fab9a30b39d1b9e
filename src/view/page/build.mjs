// Bundles the page into one file: node build.mjs OUTPUT
import { build } from 'esbuild';
import { readFile, writeFile } from 'node:fs/promises';

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

const script = (await bundle('main.js')).replaceAll('</script', '<\\/script');
const style = await bundle('style.css');
const page = (await readFile('index.html', 'utf8'))
  .replace('/* STYLE-HERE */', () => style)
  .replace('/* SCRIPT-HERE */', () => script);
await writeFile(output, page);
