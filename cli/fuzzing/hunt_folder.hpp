// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The folder of a hunt: its ledger, and a file for each cause.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "fuzz/hunt.hpp"
#include "fuzz/ledger.hpp"

namespace cli {

// What cannot be written is a Stop (kExitInternal).
class HuntFolder {
  public:
    // Makes the folder, and holds it against another hunt until the program ends. Errors (2): it
    // cannot be made, or another hunt holds it. Keeps the reference: what is written is the ledger
    // as it then is.
    HuntFolder(std::filesystem::path path, fuzz::Ledger& ledger);

    // Copies what earlier hunts found, so that this one can go on without their folders.
    void keep_earlier();
    // Takes what is not reduced out of the ledger, since the hunt draws it anew.
    void take_out_not_reduced();
    // Writes new causes, each of which is told, and the ledger: a hunt that is killed has lost
    // nothing but its last step.
    void keep(fuzz::Hunt& hunter, const std::function<void(const fuzz::Entry&)>& tell);
    void write_ledger() const;

  private:
    void write(const std::string& name, const std::string& text) const;
    // Gives the entry a file name in this folder below that of the hunt, which no other entry of
    // the ledger and no file has.
    void name_file(fuzz::Entry& entry, const std::string& below) const;
    void keep_not_reduced(const fuzz::Hunt& hunter);

    std::filesystem::path path_;
    fuzz::Ledger& ledger_;
    std::set<std::string> not_reduced_;  // files of cases as they were drawn
};

}  // namespace cli
