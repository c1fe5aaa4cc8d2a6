// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cli/options/command_table.hpp"

namespace cli {

namespace {

// Ids without their matrix part: such an id means all its leaves, and bash breaks words at ':'.
constexpr const char* kIds = "edgecase list --ids 2>/dev/null | sed 's/:.*//' | sort -u";

std::string join(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : between) + word;
    }
    return text;
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

// Text in single quotes of a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return result + "'";
}

// "run --profile|run -p": the patterns of a case on "$command $previous".
std::string patterns(const CommandEntry& command, const OptionEntry& option) {
    std::vector<std::string> words;
    for (const std::string& name : option.names) {
        words.push_back("\"" + command.name + " " + name + "\"");
    }
    return join(words, "|");
}

// What follows an option, in each shell's words: choices, files, nothing to propose.
std::string value_cases(const CommandTable& table, bool zsh) {
    std::string text;
    for (const CommandEntry& command : table.commands) {
        for (const OptionEntry& option : command.options) {
            if (option.is_positional || option.type.empty()) {
                continue;
            }
            const std::string words = join(option.choices, " ");
            std::string action = "return";
            if (!option.choices.empty()) {
                action =
                    zsh ? "compadd -- " + words + "; return"
                        : "COMPREPLY=($(compgen -W \"" + words + "\" -- \"$current\")); return";
            } else if (is_file(option)) {
                action =
                    zsh ? "_files; return" : "COMPREPLY=($(compgen -f -- \"$current\")); return";
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

}  // namespace

std::string bash_completion(const CommandTable& table) {
    std::vector<std::string> names;
    for (const CommandEntry& command : table.commands) {
        names.push_back(command.name);
    }
    std::string text =
        "# bash completion of edgecase; load it with: source <(edgecase completion bash)\n"
        "_edgecase() {\n"
        "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
        "    local command=${COMP_WORDS[1]}\n"
        "    COMPREPLY=()\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        COMPREPLY=($(compgen -W \"" +
        join(names, " ") +
        " --help --version\" -- \"$current\"))\n"
        "        return\n"
        "    fi\n"
        "    case \"$command $previous\" in\n" +
        value_cases(table, false) +
        "    esac\n"
        "    if [ \"${current#-}\" != \"$current\" ]; then\n"
        "        case \"$command\" in\n";
    for (const CommandEntry& command : table.commands) {
        text += "            " + command.name + ") COMPREPLY=($(compgen -W \"" +
                join(option_names(command), " ") + "\" -- \"$current\")) ;;\n";
    }
    text +=
        "        esac\n"
        "        return\n"
        "    fi\n"
        "    case \"$command\" in\n";
    for (const CommandEntry& command : table.commands) {
        const std::vector<std::string> words = positional_words(command);
        if (command.takes_cases()) {
            text += "        " + command.name + ") COMPREPLY=($(compgen -W \"$(" + kIds +
                    ")\" -- \"$current\") $(compgen -f -- \"$current\")) ;;\n";
        } else if (!words.empty()) {
            text += "        " + command.name + ") COMPREPLY=($(compgen -W \"" + join(words, " ") +
                    "\" -- \"$current\")) ;;\n";
        }
    }
    return text +
           "        *) COMPREPLY=($(compgen -f -- \"$current\")) ;;\n"
           "    esac\n"
           "}\n"
           "complete -o filenames -F _edgecase edgecase\n";
}

std::string zsh_completion(const CommandTable& table) {
    // _describe takes 'NAME:TEXT', so a colon in a name or text is escaped.
    const auto described = [](const std::string& name, const std::string& what) {
        std::string text = what;
        for (size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2) {
            text.insert(at, "\\");
        }
        return quoted(name + ":" + text);
    };
    std::string text =
        "#compdef edgecase\n"
        "# zsh completion of edgecase: write it to a file _edgecase in a folder of $fpath\n"
        "_edgecase() {\n"
        "    local command=${words[2]} previous=${words[CURRENT-1]}\n"
        "    local -a entries\n"
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
            text +=
                "        (" + command.name + ") compadd -- ${(f)\"$(" + kIds + ")\"}; _files ;;\n";
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

std::string fish_completion(const CommandTable& table) {
    std::string text = "# fish completion of edgecase: edgecase completion fish | source\n";
    const std::string start = "complete -c edgecase ";
    for (const CommandEntry& command : table.commands) {
        text += start + "-n __fish_use_subcommand -f -a " + command.name + " -d " +
                quoted(command.text) + "\n";
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
            if (!option.choices.empty()) {
                text += "-x -a " + quoted(join(option.choices, " ")) + " ";
            } else if (is_file(option)) {
                text += "-r -F ";
            } else if (!option.type.empty()) {
                text += "-x ";
            }
            text += "-d " + quoted(option.text) + "\n";
        }
        const std::vector<std::string> words = positional_words(command);
        if (command.takes_cases()) {
            text += when + "-a " + quoted("(" + std::string(kIds) + ")") + "\n";
        } else if (!words.empty()) {
            text += when + "-f -a " + quoted(join(words, " ")) + "\n";
        }
    }
    return text;
}

}  // namespace cli
