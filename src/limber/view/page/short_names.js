// Names as short as they can be told apart.

// Without the words, up to a separator, that all begin with: left_arm_upper and
// left_arm_lower become upper and lower.
function dropCommon(names) {
  const parts = names.map((name) => name.split(/(?<=[_/.: -])/));
  let same = 0;
  while (parts.every((words) => words.length > same + 1 && words[same] === parts[0][same])) ++same;
  return parts.map((words) => words.slice(same).join(''));
}

/// Without the names of their robots, "claw." of "claw.palm", if the rest is unique, and
/// without what all begin with.
export function shorten(names) {
  if (names.length < 2) return names;
  const own = names.map((name) => name.slice(Math.max(name.lastIndexOf('.'), name.lastIndexOf('/')) + 1));
  const isUnique = own.every((name) => name !== '') && new Set(own).size === new Set(names).size;
  const list = isUnique ? own : names;
  return new Set(list).size > 1 ? dropCommon(list) : list;
}
