// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cases/model/door.hpp"
#include "cases/model/rule.hpp"
#include "cases/model/way.hpp"
#include "cli/commands.hpp"
#include "cli/options/command_table.hpp"
#include "cli/options/shared_options.hpp"
#include "cli/options/stop.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

struct CompletionOptions {
    std::string shell;
};

std::string join(const std::vector<std::string>& words, std::string_view between) {
    return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> option_names(const CommandEntry& command) {
    std::vector<std::string> names;
    for (const OptionEntry& option : command.options) {
        if (!option.is_positional) {
            names.insert(names.end(), option.names.begin(), option.names.end());
        }
    }
    return names;
}

bool is_file(const OptionEntry& option) {
    return option.type == "FILE" || option.type == "DIR";
}

// "run --profile|run -p": the patterns of a case on "$command $previous".
std::string patterns(const CommandEntry& command, const OptionEntry& option) {
    std::vector<std::string> words;
    for (const std::string& name : option.names) {
        words.push_back("\"" + command.name + " " + name + "\"");
    }
    return join(words, "|");
}

// The words that may follow an option: its choices, doors, ways or the ids of all rules.
std::vector<std::string> values_of(const OptionEntry& option) {
    const std::string& name = option.names.back();
    std::vector<std::string> ids;
    if (name == "--doors" || name == "--ways") {
        ids = name == "--doors" ? cases::door_words() : cases::way_words();
        ids.insert(ids.begin(), {"all", "default", "none"});
        return ids;
    }
    if (name != "--rule") {
        return option.choices;
    }
    for (const cases::Rule& rule : cases::all_rules()) {
        ids.emplace_back(rule.id);
    }
    return ids;
}

// What follows an option, in each shell's words: choices, files, nothing to propose.
std::string value_cases(const CommandTable& table, bool zsh) {
    std::string text;
    for (const CommandEntry& command : table.commands) {
        for (const OptionEntry& option : command.options) {
            if (option.is_positional || option.type.empty()) {
                continue;
            }
            const std::string words = join(values_of(option), " ");
            std::string action = "return";
            if (!words.empty()) {
                action = zsh ? "compadd -- " + words + "; return"
                             : "_edgecase_words \"" + words + "\"; return";
            } else if (is_file(option)) {
                action = zsh ? "_files; return" : "_edgecase_files; return";
            }
            text += "        " + std::string(zsh ? "(" : "") + patterns(command, option) + ") " +
                    action + " ;;\n";
        }
    }
    return text;
}

// The words that a command takes in the place of an option: its choices ("bash zsh fish").
std::vector<std::string> positional_words(const CommandEntry& command) {
    for (const OptionEntry& option : command.options) {
        if (option.is_positional) {
            return option.choices;
        }
    }
    return {};
}

// "@rule:ID" of all rules.
std::string rule_selectors() {
    std::string text;
    for (const cases::Rule& rule : cases::all_rules()) {
        text += (text.empty() ? "@rule:" : " @rule:") + std::string(rule.id);
    }
    return text;
}

// Functions of the bash script. Readline breaks the line at every character of COMP_WORDBREAKS, '='
// and ':' and '@' among them, so the word is taken from the line itself, and what lies before its
// last break, which readline keeps, is taken off the answers.
constexpr const char* kBashFunctions = R"SH(_edgecase_words() {
    local word
    for word in $1; do
        [[ $word == "$current"* ]] && COMPREPLY+=("$lead$word")
    done
}
_edgecase_files() {
    local file
    while IFS= read -r file; do
        [ -d "$file" ] && file=$file/ && compopt -o nospace 2>/dev/null
        [ -n "$quote" ] || printf -v file %q "$file"
        COMPREPLY+=("$lead$file")
    done < <(compgen -f -- "$current")
}
_edgecase_cases() {
    if [ "${current#!}" != "$current" ]; then
        lead=$lead! current=${current#!}
    fi
    case "$current" in
        @*) _edgecase_words "$_edgecase_rules" ;;
        *:*) _edgecase_words "$(edgecase list --ids "${current%%:*}" 2>/dev/null)" ;;
        *)
            _edgecase_words "$(edgecase list --ids 2>/dev/null | sed 's/:.*//' | sort -u)"
            _edgecase_files
            ;;
    esac
}
)SH";

std::string bash_completion(const CommandTable& table) {
    std::vector<std::string> names;
    for (const CommandEntry& command : table.commands) {
        names.push_back(command.name);
    }
    std::string text =
        "# bash completion of edgecase; load it with: source <(edgecase completion bash)\n"
        "_edgecase_rules='" +
        rule_selectors() + "'\n" + kBashFunctions +
        R"(_edgecase_propose() {
    if [ "$place" -eq 1 ]; then
        _edgecase_words ")" +
        join(names, " ") + R"( --help --version"
        return
    fi
    if [[ $current == --*=* ]]; then
        previous=${current%%=*} lead=$previous= current=${current#*=}
    fi
    case "$command $previous" in
)" + value_cases(table, false) +
        R"(    esac
    if [ "${current#-}" != "$current" ]; then
        case "$command" in
)";
    for (const CommandEntry& command : table.commands) {
        text += "            " + command.name + ") _edgecase_words \"" +
                join(option_names(command), " ") + "\" ;;\n";
    }
    text += R"(        esac
        return
    fi
    case "$command" in
)";
    for (const CommandEntry& command : table.commands) {
        const std::vector<std::string> words = positional_words(command);
        if (command.takes_cases()) {
            text += "        " + command.name + ") _edgecase_cases ;;\n";
        } else if (!words.empty()) {
            text +=
                "        " + command.name + ") _edgecase_words \"" + join(words, " ") + "\" ;;\n";
        }
    }
    return text + R"(        *) _edgecase_files ;;
    esac
}
_edgecase() {
    local line=${COMP_LINE:0:COMP_POINT} quote='' lead='' kept='' k
    local current=${line##*[[:space:]]} words
    read -ra words <<<"$line"
    local place=$((${#words[@]} - 1)) command=${words[1]}
    if [ -z "$current" ]; then
        place=$((place + 1))
    fi
    local previous=${words[place - 1]}
    case "$current" in
        \'* | \"*) quote=${current:0:1} current=${current:1} ;;
        *)
            for ((k = 0; k < ${#current}; k++)); do
                [[ $COMP_WORDBREAKS == *"${current:k:1}"* ]] && kept=${current:0:k+1}
            done
            ;;
    esac
    COMPREPLY=()
    _edgecase_propose
    COMPREPLY=("${COMPREPLY[@]#"$kept"}")
}
complete -F _edgecase edgecase
)";
}

// What the zsh script proposes for a selector; `rules` is its caller's.
constexpr const char* kZshFunction = R"SH(_edgecase_cases() {
    compset -P '!'
    case $PREFIX in
        (@*) compadd -- $rules ;;
        (*:*) compadd -- ${(f)"$(edgecase list --ids ${PREFIX%%:*} 2>/dev/null)"} ;;
        (*) compadd -- ${(f)"$(edgecase list --ids 2>/dev/null | sed 's/:.*//' | sort -u)"}; _files ;;
    esac
}
)SH";

std::string zsh_completion(const CommandTable& table) {
    // _describe takes 'NAME:TEXT', so a colon in a name or text is escaped.
    const auto described = [](const std::string& name, const std::string& what) {
        std::string text = what;
        for (size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2) {
            text.insert(at, "\\");
        }
        return shell_quote(name + ":" + text);
    };
    std::string text =
        "#compdef edgecase\n"
        "# zsh completion of edgecase: write it to a file _edgecase in a folder of $fpath\n" +
        std::string(kZshFunction) +
        "_edgecase() {\n"
        "    local command=${words[2]} previous=${words[CURRENT-1]}\n"
        "    local -a entries rules=(" +
        rule_selectors() +
        ")\n"
        "    if (( CURRENT == 2 )); then\n"
        "        entries=(";
    for (const CommandEntry& command : table.commands) {
        text += "\n            " + described(command.name, command.text);
    }
    text +=
        ")\n"
        "        _describe command entries\n"
        "        return\n"
        "    fi\n"
        "    if [[ $PREFIX == --*=* ]]; then\n"
        "        previous=${PREFIX%%=*}\n"
        "        compset -P '*='\n"
        "    fi\n"
        "    case \"$command $previous\" in\n" +
        value_cases(table, true) +
        "    esac\n"
        "    if [[ ${words[CURRENT]} == -* ]]; then\n"
        "        case \"$command\" in\n";
    for (const CommandEntry& command : table.commands) {
        text += "            (" + command.name + ") entries=(";
        for (const OptionEntry& option : command.options) {
            if (!option.is_positional) {
                for (const std::string& name : option.names) {
                    text += "\n                " + described(name, option.text);
                }
            }
        }
        text += ") ;;\n";
    }
    text +=
        "        esac\n"
        "        _describe option entries\n"
        "        return\n"
        "    fi\n"
        "    case \"$command\" in\n";
    for (const CommandEntry& command : table.commands) {
        const std::vector<std::string> words = positional_words(command);
        if (command.takes_cases()) {
            text += "        (" + command.name + ") _edgecase_cases ;;\n";
        } else if (!words.empty()) {
            text += "        (" + command.name + ") compadd -- " + join(words, " ") + " ;;\n";
        }
    }
    return text +
           "        (*) _files ;;\n"
           "    esac\n"
           "}\n"
           "compdef _edgecase edgecase\n";
}

// What the fish script proposes for a selector.
constexpr const char* kFishFunction = R"SH(function __edgecase_cases
    set -l bang (string match -r '^!?' -- (commandline -ct))
    set -l word (string replace -r '^!' '' -- (commandline -ct))
    switch $word
        case '@*'
            string join \n -- $bang$__edgecase_rules
        case '*:*'
            string join \n -- $bang(edgecase list --ids (string replace -r ':.*' '' -- $word) 2>/dev/null)
        case '*'
            string join \n -- $bang(edgecase list --ids 2>/dev/null | sed 's/:.*//' | sort -u)
    end
end
)SH";

std::string fish_completion(const CommandTable& table) {
    std::string text =
        "# fish completion of edgecase: edgecase completion fish | source\n"
        "set -g __edgecase_rules " +
        rule_selectors() + "\n" + kFishFunction;
    const std::string start = "complete -c edgecase ";
    for (const CommandEntry& command : table.commands) {
        text += start + "-n __fish_use_subcommand -f -a " + command.name + " -d " +
                shell_quote(command.text) + "\n";
    }
    for (const CommandEntry& command : table.commands) {
        const std::string when = start + "-n '__fish_seen_subcommand_from " + command.name + "' ";
        for (const OptionEntry& option : command.options) {
            if (option.is_positional) {
                continue;
            }
            text += when;
            for (const std::string& name : option.names) {
                text += name.starts_with("--") ? "-l " + name.substr(2) + " "
                                               : "-s " + name.substr(1) + " ";
            }
            if (const std::vector<std::string> values = values_of(option); !values.empty()) {
                text += "-x -a " + shell_quote(join(values, " ")) + " ";
            } else if (is_file(option)) {
                text += "-r -F ";
            } else if (!option.type.empty()) {
                text += "-x ";
            }
            text += "-d " + shell_quote(option.text) + "\n";
        }
        const std::vector<std::string> words = positional_words(command);
        if (command.takes_cases()) {
            text += when + "-a '(__edgecase_cases)'\n";
        } else if (!words.empty()) {
            text += when + "-f -a " + shell_quote(join(words, " ")) + "\n";
        }
    }
    return text;
}

int carry_out(const Program&, const CompletionOptions& options) {
    const CommandTable table = command_table(all_commands());
    const std::string text = options.shell == "bash"  ? bash_completion(table)
                             : options.shell == "zsh" ? zsh_completion(table)
                                                      : fish_completion(table);
    say(text);
    return report::kExitOk;
}

void declare(CLI::App& app, CompletionOptions& o) {
    static const std::map<std::string, std::string> kShells = {
        {"bash", "bash"}, {"fish", "fish"}, {"zsh", "zsh"}};
    add_choice(&app, "SHELL", o.shell, kShells, "the shell")->required();
}

}  // namespace

Command completion_command() {
    return make_command<CompletionOptions>(
        {"completion", kProgram, "print the completion script of a shell",
         "  source <(edgecase completion bash)\n"
         "  edgecase completion fish > ~/.config/fish/completions/edgecase.fish\n"},
        declare, carry_out);
}

}  // namespace cli
