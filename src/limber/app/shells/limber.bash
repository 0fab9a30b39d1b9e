# Completion of limber for bash: `limber __complete` knows what may stand where.
_limber() {
  local word
  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    COMPREPLY+=("$word")
  done < <("${COMP_WORDS[0]}" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  # Behind --option= bash replaces the part after it alone.
  if [[ ${COMP_WORDS[COMP_CWORD]} == = || ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then
    COMPREPLY=("${COMPREPLY[@]#*=}")
  fi
}
complete -o bashdefault -o default -F _limber limber
