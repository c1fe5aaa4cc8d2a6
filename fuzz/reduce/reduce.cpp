// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/reduce/reduce.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "cases/load/loader.hpp"
#include "cases/model/triangle.hpp"
#include "fuzz/reduce/edits.hpp"

namespace fuzz {

namespace {

size_t keys_of(const Document& value) {
    size_t keys = value.table.size();
    for (const cases::TomlEntry& entry : value.table) {
        keys += keys_of(entry.value);
    }
    for (const Document& element : value.array) {
        keys += keys_of(element);
    }
    return keys;
}

// How large a case is; nothing if the document is none.
using Size = std::array<uint64_t, 6>;
std::optional<Size> size_of(const Document& document, const std::string& text) {
    const auto loaded = cases::load_text(text, "reduced", "reduced");
    if (!loaded || loaded->size() != 1) {
        return std::nullopt;
    }
    const cases::Case& c = loaded->front();
    const uint64_t digits =
        std::accumulate(text.begin(), text.end(), uint64_t{0}, [](uint64_t sum, char letter) {
            return sum + (letter >= '0' && letter <= '9' ? static_cast<uint64_t>(letter - '0') : 0);
        });
    return Size{c.draws.size(),
                cases::assemble(c).size(),
                keys_of(document),
                uint64_t{c.target.width} * c.target.height * c.target.samples * c.target.layers,
                text.size(),
                digits};
}

struct Candidate {
    const Edit* edit = nullptr;
    Document document;
    std::string text;
};

class Reducer {
  public:
    Reducer(Document document, const Shows& shows, const ReduceOptions& options)
        : shows_(shows), options_(options) {
        out_.document = std::move(document);
        text_ = to_text(out_.document);
        size_ = size_of(out_.document, text_).value_or(Size{});
    }

    Reduced run() {
        while (out_.rounds < options_.most_rounds && !out_.is_minimal) {
            ++out_.rounds;
            const std::vector<Edit> all = edits(out_.document);
            out_.is_minimal = !round(all);
            if (out_.is_minimal) {
                tell_needs(all);
            }
        }
        return std::move(out_);
    }

  private:
    // What an edit makes of a document, if that is a smaller case.
    std::optional<Candidate> apply(const Edit& edit, const Document& to, const Size& size) const {
        Candidate candidate{&edit, to, {}};
        if (!edit.apply(candidate.document)) {
            return std::nullopt;
        }
        candidate.text = to_text(candidate.document);
        const std::optional<Size> now = size_of(candidate.document, candidate.text);
        if (!now || *now >= size) {
            return std::nullopt;
        }
        return candidate;
    }

    std::vector<bool> ask(const std::vector<Candidate>& candidates) {
        std::vector<std::string> texts;
        for (const Candidate& candidate : candidates) {
            texts.push_back(candidate.text);
        }
        out_.tried += texts.size();
        return texts.empty() ? std::vector<bool>() : shows_(texts);
    }

    // False if no edit gives a smaller case that shows it.
    bool round(const std::vector<Edit>& all) {
        failed_.clear();
        for (size_t next = 0; next < all.size();) {
            std::vector<Candidate> batch;
            for (; next < all.size() && batch.size() < options_.batch; ++next) {
                std::optional<Candidate> candidate = apply(all[next], out_.document, size_);
                if (candidate && tried_.contains(candidate->text)) {
                    failed_.push_back(&all[next]);
                } else if (candidate) {
                    batch.push_back(std::move(*candidate));
                }
            }
            const std::vector<bool> answers = ask(batch);
            std::vector<const Edit*> good;
            for (size_t k = 0; k < batch.size(); ++k) {
                if (!answers[k]) {
                    failed_.push_back(batch[k].edit);
                    tried_.insert(batch[k].text);
                } else {
                    good.push_back(batch[k].edit);
                }
            }
            if (!good.empty()) {
                take(good);
                return true;
            }
        }
        return false;
    }

    // The first of the edits, each of which shows it alone, and as many more as show it together.
    void take(const std::vector<const Edit*>& good) {
        std::vector<Candidate> chain;
        Document document = out_.document;
        Size size = size_;
        for (const Edit* edit : good) {
            std::optional<Candidate> candidate = apply(*edit, document, size);
            if (candidate) {
                document = candidate->document;
                size = *size_of(document, candidate->text);
                chain.push_back(std::move(*candidate));
            }
        }
        std::vector<bool> answers{true};
        if (chain.size() > 1) {
            const std::vector<Candidate> rest(chain.begin() + 1, chain.end());
            const std::vector<bool> more = ask(rest);
            answers.insert(answers.end(), more.begin(), more.end());
        }
        size_t last = 0;
        for (size_t k = 0; k < chain.size(); ++k) {
            last = answers[k] ? k : last;
        }
        out_.document = std::move(chain[last].document);
        text_ = chain[last].text;
        size_ = *size_of(out_.document, text_);
    }

    void tell_needs(const std::vector<Edit>& all) {
        for (const Edit& edit : all) {
            if (edit.is_feature &&
                std::find(failed_.begin(), failed_.end(), &edit) != failed_.end()) {
                out_.needs.push_back("not " + edit.what);
            }
        }
    }

    const Shows& shows_;
    ReduceOptions options_;
    Reduced out_;
    std::string text_;
    Size size_{};
    std::set<std::string> tried_;      // texts that did not show it
    std::vector<const Edit*> failed_;  // of this round
};

}  // namespace

Reduced reduce(Document document, const Shows& shows, const ReduceOptions& options) {
    return Reducer(std::move(document), shows, options).run();
}

}  // namespace fuzz
