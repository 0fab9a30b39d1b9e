# Completion of limber for fish: `limber __complete` knows what may stand where.
function __limber_complete
    set -l words (commandline -opc)
    $words[1] __complete $words[2..-1] (commandline -ct) 2>/dev/null
end
complete -c limber -a '(__limber_complete)'
