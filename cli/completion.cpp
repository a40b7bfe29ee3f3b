// bash and zsh: the same tables, read by two functions of each.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/completion_parts.h"

namespace parity::cli {

namespace {

// In single quotes, as sh and zsh read it.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// Assignments, which bash and zsh read alike.
std::string tableEntry(const CompletedValues& values) {
  return fmt::format("names=({}) kinds=({}) files={} folders={}",
                     fmt::join(
                         [&] {
                           std::vector<std::string> words;
                           for (const std::string& name : values.names) words.push_back(quoted(name));
                           return words;
                         }(),
                         " "),
                     fmt::join(values.extensions, " "), values.isFile ? 1 : 0, values.isFolder ? 1 : 0);
}

// case COMMAND:OPTION of all that takes a value, and COMMAND of the positionals: the same in bash and in zsh.
std::string valueCases(const CompletionInput& input) {
  std::string text;
  for (const CommandText* command : flatten(input.program)) {
    for (const OptionText& option : optionsOf(*command)) {
      if (option.value.empty()) continue;
      std::vector<std::string> labels;
      for (const std::string& name : option.names) labels.push_back(quoted(command->name + ":" + name));
      text += fmt::format("    {}) takes=1 {} ;;\n", fmt::join(labels, "|"), tableEntry(valuesOf(option, input)));
    }
    const CompletedValues all = valuesOfPositionals(*command, input);
    if (all.isAnything()) text += fmt::format("    {}) {} ;;\n", quoted(command->name + ":"), tableEntry(all));
  }
  return text;
}

std::string commandNames(const CommandText& program) {
  std::vector<std::string> names;
  for (const CommandText* command : flatten(program))
    if (!command->name.empty()) names.push_back(quoted(command->name));
  return fmt::format("{}", fmt::join(names, "|"));
}

// The lines of _parity_words(): for each command its options and the commands below it, each as `entry` writes it.
template <typename Entry> std::string commandLines(const CommandText& program, const Entry& entry) {
  std::string lines;
  for (const CommandText* command : flatten(program)) {
    std::vector<std::string> names, below;
    for (const OptionText& option : optionsOf(*command))
      for (const std::string& name : option.names) names.push_back(entry(name, option.help));
    for (const CommandText& each : command->commands) below.push_back(entry(lastWord(each.name), each.help));
    lines += fmt::format("    {}) optionlist=({}) commandlist=({}) ;;\n", quoted(command->name), fmt::join(names, " "),
                         fmt::join(below, " "));
  }
  return lines;
}

} // namespace

std::string bashScript(const CompletionInput& input) {
  const std::string words =
      commandLines(input.program, [](const std::string& name, const std::string&) { return name; });
  return fmt::format(R"sh(# bash completion of parity, made by `parity completion bash`.
_parity_words() {{ # COMMAND: its options and the commands below it
  optionlist=() commandlist=()
  case $1 in
{}  esac
}}
_parity_values() {{ # COMMAND:OPTION, or COMMAND: for what is no option
  names=() kinds=() files=0 folders=0 takes=0
  case $1 in
{}  esac
}}
_parity() {{
  # Words as the user sees them: bash also breaks them at = and :.
  local -a words=()
  local i joins=0
  for ((i = 1; i <= COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      [=:] | [=:][=:]*) if ((${{#words[@]}})); then words[-1]+=${{COMP_WORDS[i]}} joins=1; continue; fi ;;
    esac
    if ((joins)); then words[-1]+=${{COMP_WORDS[i]}}; else words+=("${{COMP_WORDS[i]}}"); fi
    joins=0
  done
  local current=${{words[-1]-}} command= previous= word optionlist commandlist names kinds files folders takes
  ((${{#words[@]}})) && unset 'words[-1]'
  for word in "${{words[@]}}"; do
    case "${{command:+$command }}$word" in {}) command="${{command:+$command }}$word" ;; esac
    previous=$word
  done
  _parity_words "$command"
  local lead=
  case $current in
    --*=*) previous=${{current%%=*}} lead=${{current%%=*}}= current=${{current#*=}} ;;
  esac
  takes=0
  case $previous in -*) _parity_values "$command:$previous" ;; esac
  local -a found=()
  if ((!takes)); then
    if [[ -z $lead && $current == -* ]]; then
      mapfile -t found < <(compgen -W "${{optionlist[*]}}" -- "$current")
      COMPREPLY=("${{found[@]}}")
      return
    fi
    _parity_values "$command:"
    names+=("${{commandlist[@]}}")
  fi
  for word in "${{names[@]}}"; do [[ $word == "$current"* ]] && found+=("$word"); done
  if ((files || folders || ${{#kinds[@]}})); then
    compopt -o filenames 2>/dev/null # readline quotes, and ends folders in a slash
    local file kind plain=${{current//\\/}}
    while IFS= read -r file; do
      if ((files)) || [[ -d $file ]]; then found+=("$file"); continue; fi
      for kind in "${{kinds[@]}}"; do [[ ${{file,,}} == *."$kind" ]] && found+=("$file"); done
    done < <(compgen -f -- "$plain")
  fi
  # What bash has taken for a word of its own is not said again.
  local cut=
  [[ $current == *:* && $COMP_WORDBREAKS == *:* ]] && cut=${{current%"${{current##*:}}"}}
  COMPREPLY=()
  for word in "${{found[@]}}"; do
    ((files || folders || ${{#kinds[@]}})) || printf -v word %q "$word"
    COMPREPLY+=("${{word#"$cut"}}")
  done
}}
complete -F _parity parity
)sh",
                     words, valueCases(input), commandNames(input.program));
}

std::string zshScript(const CompletionInput& input) {
  const std::string words = commandLines(input.program, [](const std::string& name, const std::string& help) {
    return quoted(name + ":" + summaryOf(help));
  });
  return fmt::format(R"sh(#compdef parity
# zsh completion of parity, made by `parity completion zsh`.
_parity_words() {{ # COMMAND: its options and the commands below it, each with what it does
  optionlist=() commandlist=()
  case $1 in
{}  esac
}}
_parity_values() {{ # COMMAND:OPTION, or COMMAND: for what is no option
  names=() kinds=() files=0 folders=0 takes=0
  case $1 in
{}  esac
}}
_parity() {{
  local command= previous= word lead=
  local -a optionlist commandlist names kinds
  integer files=0 folders=0 takes=0 found=1
  for word in "${{(@Q)words[2,CURRENT-1]}}"; do
    case "${{command:+$command }}$word" in ({}) command="${{command:+$command }}$word" ;; esac
    previous=$word
  done
  _parity_words "$command"
  if [[ $PREFIX == --*=* ]]; then
    previous=${{PREFIX%%=*}}
    compset -P '*='
    lead=1
  fi
  [[ $previous == -* ]] && _parity_values "$command:$previous"
  if (( ! takes )); then
    if [[ -z $lead && $PREFIX == -* ]]; then
      _describe -o option optionlist
      return
    fi
    _parity_values "$command:"
    (( $#commandlist )) && _describe command commandlist && found=0
  fi
  (( $#names )) && compadd -a names && found=0
  if (( files )); then
    _files && found=0
  elif (( $#kinds )); then
    _files -g "*.(#i)(${{(j:|:)kinds}})" && found=0
  elif (( folders )); then
    _files -/ && found=0
  fi
  return found
}}
if [[ $funcstack[1] == _parity ]]; then
  _parity "$@"
else
  compdef _parity parity
fi
)sh",
                     words, valueCases(input), commandNames(input.program));
}

} // namespace parity::cli
