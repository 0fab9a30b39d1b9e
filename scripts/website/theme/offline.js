// SPDX-License-Identifier: BSD-3-Clause
// Search of a page from disk, where browsers allow neither fetch nor workers: the index is a
// script, and the worker's program runs in a hidden frame.
if (location.protocol === "file:") {
  const source = document.currentScript.dataset.index;
  var __search = {
    index: new Promise((resolve) => addEventListener("DOMContentLoaded", () => {
      const script = document.createElement("script");
      script.src = source;
      script.onload = () => resolve(limber_search_index);
      document.head.append(script);
    })),
  };

  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      const program = frame.contentDocument;
      program.open();
      program.write("<script>postMessage = (data) => parent.postMessage(data, '*');" +
        "importScripts = (...urls) => urls.reduce((done, url) => done.then(() => new Promise((resolve) => {" +
        "const s = document.createElement('script'); s.src = url; s.onload = resolve;" +
        `document.head.append(s); })), Promise.resolve());<\/script><script src="${url}"><\/script>`);
      program.close();
      this.ready = new Promise((resolve) => { frame.onload = resolve; });
      this.frame = frame;
      addEventListener("message", (event) => {
        if (event.source === frame.contentWindow) {
          this.dispatchEvent(new MessageEvent("message", { data: event.data }));
        }
      });
    }

    postMessage(data) {
      this.ready.then(() => this.frame.contentWindow.dispatchEvent(
        new MessageEvent("message", { data })));
    }

    terminate() { this.frame.remove(); }
  };
}
