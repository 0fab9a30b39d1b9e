// The bar below: play, time, speed, the slider with its events, the interval.
import { format } from './colours.js';
import { kSpeeds } from './player.js';

const nameSpeed = (speed) => (speed >= 1 ? `${speed}\u00d7` : `1/${Math.round(1 / speed)}`);

const kMarkup = `
<button id="play" class="sign" title="Play or pause (space)"></button>
<span id="clock"></span>
<div id="track">
  <div id="loop"></div><div id="ticks"></div>
  <input id="slider" type="range" min="0" max="100000" step="1" aria-label="time">
</div>
<label title="Speed (+, -)">speed <select id="speed"></select></label>
<span class="group">
  <button id="from" title="The interval begins here ([)">[</button>
  <button id="to" title="The interval ends here (])">]</button>
  <button id="whole" title="The whole run (\\)">all</button>
</span>`;

export class Timeline {
  constructor(element, player, events) {
    this.player = player;
    element.innerHTML = kMarkup;
    this.find = (id) => element.querySelector(`#${id}`);
    this.find('speed').innerHTML = kSpeeds
      .map((speed) => `<option value="${speed}">${nameSpeed(speed)}</option>`)
      .join('');
    this.find('play').onclick = () => player.toggle();
    this.find('speed').onchange = (e) => player.setSpeed(Number(e.target.value));
    this.find('from').onclick = () => player.setInterval(player.time, player.to);
    this.find('to').onclick = () => player.setInterval(player.from, player.time);
    this.find('whole').onclick = () => player.setInterval(player.start, player.end);
    this.find('slider').oninput = (e) => {
      // Before the pause, which puts the slider back to the page's time.
      const share = e.target.value / 1e5;
      player.pause();
      player.seek(player.start + share * (player.end - player.start));
    };
    this.addEvents(events);
    player.onChange(() => this.update());
    this.update();
  }

  share(t) {
    const { start, end } = this.player;
    return end > start ? (t - start) / (end - start) : 0;
  }

  // A time since the start.
  tell(t) {
    return format(t - this.player.start, 's');
  }

  // Events at one place on the bar share a mark.
  addEvents(events) {
    const groups = new Map();
    for (const event of events) {
      const place = Math.round(400 * this.share(event.time));
      if (!groups.has(place)) groups.set(place, []);
      groups.get(place).push(event);
    }
    for (const group of groups.values()) {
      const tick = document.createElement('button');
      tick.className = 'tick';
      tick.style.left = `${100 * this.share(group[0].time)}%`;
      tick.title = group
        .slice(0, 12)
        .map((e) => `${this.tell(e.time)}  ${e.source}: ${e.what}`)
        .join('\n') + (group.length > 12 ? `\nand ${group.length - 12} more` : '');
      tick.onclick = () => {
        this.player.pause();
        this.player.seek(group[0].time);
      };
      this.find('ticks').append(tick);
    }
  }

  update() {
    const { player } = this;
    this.find('play').classList.toggle('pause', player.isPlaying);
    this.find('clock').textContent = `${this.tell(player.time)} of ${this.tell(player.end)}` +
      (player.start === 0 ? '' : ` from ${player.start} s on`);
    this.find('slider').value = 1e5 * this.share(player.time);
    this.find('speed').value = player.speed;
    const loop = this.find('loop');
    loop.style.left = `${100 * this.share(player.from)}%`;
    loop.style.width = `${100 * (this.share(player.to) - this.share(player.from))}%`;
    loop.hidden = player.from === player.start && player.to === player.end;
  }
}
