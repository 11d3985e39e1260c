# Completion of bipact and bipact-fclib in bash. The options are those that --help of the program
# names, so that they are listed in one place.

# Names that the *PARAMETER cards of a deck define, one a line.
_bipact_parameters() {
  awk '
    /^\$/ { next }
    /^\*/ { inside = toupper($1) == "*PARAMETER"; next }
    !inside { next }
    /,/ { n = split($0, part, ","); for (i = 1; i < n; i += 2) name(part[i]); next }
    { for (i = 1; i <= length($0); i += 20) name(substr($0, i, 10)) }
    function name(text) {
      sub(/^ +/, "", text)
      text = substr(text, 2)
      gsub(/ /, "", text)
      if (text != "") print tolower(text)
    }' "$1" 2>/dev/null
}

# The deck among the words of the command line: the first file that is no value of an option.
_bipact_deck() {
  local k
  for ((k = 1; k < ${#COMP_WORDS[@]}; k++)); do
    [[ ${COMP_WORDS[k - 1]} == -[oD] || ${COMP_WORDS[k - 1]} == --@(restart|threads) ]] && continue
    [[ ${COMP_WORDS[k]} != -* && -f ${COMP_WORDS[k]} ]] && echo "${COMP_WORDS[k]}" && return
  done
}

# Files whose names match a pattern, and folders on the way to them.
_bipact_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$2"; shopt -s extglob; compgen -f -X "!$1" -- "$2")
}

_bipact() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local program=${COMP_WORDS[0]/#\~/$HOME} decks='*.@(k|key|dyn)' problems='*.@(hdf5|h5|txt)'
  COMPREPLY=()
  case $before in
    -D)
      compopt -o nospace 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -S = -W "$(_bipact_parameters "$(_bipact_deck)")" -- "$word")
      return ;;
    -o)
      if [[ $program == *fclib* ]]; then _bipact_files '*' "$word"; return; fi
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return ;;
    --restart)
      _bipact_files '*.h5' "$word"
      [[ latest == "$word"* ]] && COMPREPLY+=(latest)
      return ;;
    --threads)
      mapfile -t COMPREPLY < <(compgen -W "1 2 4 8" -- "$word")
      return ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W \
      "$("$program" --help 2>/dev/null | grep -oE -- '(^|[[ ])--?[a-zA-Z][a-z-]*' | tr -d ' [' | sort -u)" \
      -- "$word")
  elif [[ $program == *fclib* ]]; then
    _bipact_files "$problems" "$word"
  else
    _bipact_files "$decks" "$word"
  fi
}

complete -F _bipact bipact bipact-fclib
