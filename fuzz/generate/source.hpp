// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a hunt's cases come from: a number makes a case, on every machine alike.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cases/load/loader.hpp"
#include "fuzz/generate/generator.hpp"
#include "fuzz/generate/pose.hpp"

namespace fuzz {

class Source {
  public:
    struct Made {
        std::string text;                 // empty: this number has no case
        std::optional<cases::Case> data;  // of the text; the number is its id
        uint64_t refused = 0;             // texts that the loader did not take
    };
    Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    virtual ~Source() = default;
    // So many numbers make a group, whose cases share most of what costs a driver a pipeline.
    virtual uint64_t group_size() const = 0;
    // Goes to a group, which must not be below the last one.
    virtual void enter(uint64_t group) = 0;
    // The case of a number of the group that was entered last.
    virtual Made make(uint64_t number) const = 0;
    virtual size_t pairs() const { return 0; }  // of features that have met
};
using MakeSource = std::function<std::unique_ptr<Source>()>;

// Cases that nobody wrote: poses with some geometries each.
class GeneratedSource : public Source {
  public:
    explicit GeneratedSource(uint64_t seed) : seed_(seed), poses_(seed) {}
    uint64_t group_size() const override { return kGeometries; }
    void enter(uint64_t group) override;
    Made make(uint64_t number) const override;
    size_t pairs() const override { return poses_.pairs(); }

  private:
    uint64_t seed_;
    Poses poses_;
    Pose pose_;
};

// The case of a text or document with one leaf; nothing if it is no such one.
std::optional<cases::Case> load_one(const std::string& text, const std::string& id);
std::optional<cases::Case> load_one(const cases::TomlValue& document, const std::string& id);

}  // namespace fuzz
