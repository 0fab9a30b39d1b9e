// Sliders and choices of a playground, and the part of the address that holds them.

const kDigits = 4;

function makeSlider(control, change) {
  const label = document.createElement('label');
  const name = Object.assign(document.createElement('span'), { textContent: control.label });
  const shown = document.createElement('output');
  const input = Object.assign(document.createElement('input'), {
    type: 'range', min: control.min, max: control.max, name: control.path,
    step: control.whole ? 1 : 'any',
  });
  const show = () => {
    const value = Number(Number(input.value).toPrecision(kDigits));
    shown.textContent = `${value} ${control.unit}`;
    return value;
  };
  input.oninput = () => {
    show();
    change();
  };
  label.append(name, shown, input);
  return {
    label,
    read: () => show(),
    write(value) {
      input.value = value;
      show();
    },
    // A text for what is not taken as it is.
    wish(text) {
      const value = text.trim() === '' ? NaN : Number(text);
      if (!Number.isFinite(value)) return `it is no number`;
      this.write(value);
      if (value < control.min) return `the least is ${control.min}, which is taken`;
      if (value > control.max) return `the most is ${control.max}, which is taken`;
      return control.whole && value !== Math.round(value) ? 'it is no whole number, and rounded' : '';
    },
  };
}

function makeChoice(control, change) {
  const label = document.createElement('label');
  const select = Object.assign(document.createElement('select'), { name: control.path });
  for (const choice of control.choices) select.append(new Option(choice, choice));
  select.onchange = change;
  label.append(control.label, select);
  return {
    label,
    read: () => select.value,
    write: (value) => (select.value = value),
    wish(text) {
      if (!control.choices.includes(text)) return `the choices are ${control.choices.join(', ')}`;
      select.value = text;
      return '';
    },
  };
}

export class Controls {
  /// @param list of { label, path, value, unit, min, max } or { label, path, value, choices }
  constructor(form, list, change) {
    this.rows = list.map((control) => {
      const row = control.choices ? makeChoice(control, change) : makeSlider(control, change);
      form.append(row.label);
      row.write(control.value);
      return { control, ...row };
    });
  }

  reset() {
    for (const row of this.rows) row.write(row.control.value);
  }

  /// Values that differ from those of the scenario, by path.
  changed() {
    return this.rows.flatMap(({ control, read }) => {
      const value = read();
      const given = control.choices
        ? control.value : Number(Number(control.value).toPrecision(kDigits));
      return value === given ? [] : [[control.path, value]];
    });
  }

  /// Lines PATH=VALUE of what differs; vectors as a whole.
  settings() {
    const lines = new Map();
    for (const [path, value] of this.changed()) {
      const { vector } = this.rows.find(({ control }) => control.path === path).control;
      if (vector) lines.set(vector, `[${this.components(vector).join(', ')}]`);
      else lines.set(path, value);
    }
    return [...lines].map(([path, value]) => `${path}=${value}`);
  }

  components(vector) {
    const moved = new Map(this.changed());
    return this.rows.filter(({ control }) => control.vector === vector)
      .map(({ control }) => moved.get(control.path) ?? control.value);
  }

  get(path) {
    return this.rows.find(({ control }) => control.path === path)?.read();
  }

  toHash() {
    return new URLSearchParams(this.changed()).toString();
  }

  /// @returns texts for what is not taken as it is
  readHash(hash) {
    return [...new URLSearchParams(hash.replace(/^#/, ''))].flatMap(([path, text]) => {
      const row = this.rows.find(({ control }) => control.path === path);
      const refused = row ? row.wish(text) : 'this page has no such value';
      return refused ? [`${path} = ${text} of the link: ${refused}`] : [];
    });
  }
}
