// The worker of a playground: holds the module, and simulates what it is sent. Its text
// goes into a Worker behind the module's, so it uses nothing from outside itself.
/* global LimberModule */

export function workPlayground() {
  const kPause = 100;  // between reports [ms]
  let module;
  let reported = 0;

  // Called by the module.
  globalThis.LimberProgress = (fraction) => {
    const now = performance.now();
    if (now < reported + kPause) return;
    reported = now;
    postMessage({ progress: fraction });
  };

  function decode(base64) {
    return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  }

  async function load({ wasm, files, bodies }) {
    module = await LimberModule({ wasmBinary: decode(wasm), print() {}, printErr() {} });
    for (const [name, content] of Object.entries(files)) {
      module.FS.mkdirTree(name.slice(0, name.lastIndexOf('/')) || '/');
      module.FS.writeFile(name, decode(content));
    }
    for (const [link, file] of Object.entries(bodies)) {
      module.ccall('limber_give_body', null, ['string', 'string'], [link, file]);
    }
    return { ready: true };
  }

  const readAnswer = () => module.UTF8ToString(module._limber_answer());

  // Each of `runs` is a list of settings; the first is shown, others are its ghosts.
  function play({ scenario, runs }) {
    const answers = [];
    reported = performance.now() + kPause;  // short runs need no reports
    for (const settings of runs) {
      const status = module.ccall(
        'limber_play', 'number', ['string', 'string'], [scenario, settings.join('\n')]);
      if (status !== 0) {
        module._limber_forget();
        return { problem: readAnswer() };
      }
      answers.push(JSON.parse(readAnswer()));
    }
    if (module._limber_show() !== 0) return { problem: readAnswer() };
    const at = module._limber_data();
    return { answers, bytes: module.HEAPU8.slice(at, at + module._limber_size()).buffer };
  }

  onmessage = async ({ data }) => {
    try {
      const reply = data.wasm ? await load(data) : play(data);
      postMessage(reply, reply.bytes ? [reply.bytes] : []);
    } catch (error) {
      postMessage({ problem: String(error.message ?? error), isBroken: true });
    }
  };
}
