// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0

#include "cli/commands.hpp"
#include "cli/options/command_table.hpp"
#include "cli/options/program.hpp"
#include "cli/options/stop.hpp"
#include "report/record/run.hpp"

namespace cli {

namespace {

// Text as roff shows it: backslashes and hyphens escaped, no line that begins like a request.
std::string roff(const std::string& text) {
    std::string result;
    bool begins = true;
    for (const char c : text) {
        if (begins && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        begins = c == '\n';
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            result += c;
        }
    }
    return result;
}

// Lines as they are.
std::string verbatim(const std::string& text) {
    return ".nf\n" + roff(text) + (text.ends_with('\n') ? "" : "\n") + ".fi\n";
}

std::string option_text(const OptionEntry& option) {
    std::string text = ".TP\n";
    for (size_t k = 0; k < option.names.size(); ++k) {
        text += (k == 0 ? "\\fB" : ", \\fB") + roff(option.names[k]) + "\\fR";
    }
    if (!option.type.empty()) {
        text += " \\fI" + roff(option.type) + "\\fR";
    }
    return text + "\n" + roff(option.text) + "\n";
}

std::string manual_page(const CommandTable& table, const std::string& version) {
    std::string text =
        ".\\\" Made by 'edgecase man' from the table of options.\n.TH EDGECASE 1 \"\" \"edgecase " +
        roff(version) + "\"\n.SH NAME\nedgecase \\- " + roff(table.text) +
        "\n.SH SYNOPSIS\n.B edgecase\n.I COMMAND\n[\\fIOPTIONS\\fR] "
        "[\\fISELECTOR\\fR...]\n.SH COMMANDS\n";
    for (const CommandEntry& command : table.commands) {
        text += ".SS edgecase " + roff(command.name) + "\n" + roff(command.text) + ".\n";
        for (const OptionEntry& option : command.options) {
            if (!option.is_positional) {
                text += option_text(option);
            }
        }
        if (command.footer != table.footer && !command.footer.empty()) {
            text += ".PP\n" + verbatim(command.footer);
        }
    }
    text += ".SH NOTES\n" + verbatim(table.footer);
    return text + ".SH SEE ALSO\ndocs/cli.md, docs/cases.md and docs/rules.md of the source tree\n";
}

int carry_out(const Program&) {
    say(manual_page(command_table(all_commands()), kVersion));
    return report::kExitOk;
}

}  // namespace

Command man_command() {
    return make_command({"man", kProgram, "print the manual page", "  edgecase man | man -l -\n"},
                        carry_out);
}

}  // namespace cli
