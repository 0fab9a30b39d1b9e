// Sliders and choices of a playground, and the part of the address that holds them.

const kDigits = 4;

function makeSlider(control, change) {
  const label = document.createElement('label');
  const name = Object.assign(document.createElement('span'), { textContent: control.label });
  const shown = document.createElement('output');
  const input = Object.assign(document.createElement('input'), {
    type: 'range', min: control.min, max: control.max, step: 'any', name: control.path,
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

  get(path) {
    return this.rows.find(({ control }) => control.path === path)?.read();
  }

  toHash() {
    return new URLSearchParams(this.changed()).toString();
  }

  readHash(hash) {
    const wishes = new URLSearchParams(hash.replace(/^#/, ''));
    for (const { control, write } of this.rows) {
      if (wishes.has(control.path)) write(wishes.get(control.path));
    }
  }
}
