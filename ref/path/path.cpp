// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "ref/path/path.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "ref/path/certain.hpp"

namespace ref::path {

namespace {

using cases::kStencilBits;

// Short ones need no memory of their own.
using Numbers = std::u32string;

// What a path did with a fragment: whether it shows, and as which face, or is discarded once it has
// passed.
enum class Deed : uint8_t { hidden, discarded, front, back };

// How paths stand after some fragments: all that their future and the observers depend on. What
// nobody observes stays 0.
struct State {
    uint32_t value = 0;            // the stencil
    int stored = kClearDepth;      // whose depth
    uint32_t front = 0, back = 0;  // hits
    uint32_t trace = 0;            // the fragments that show (Search::traces_)
    uint32_t counted = 0;          // fragments that passed, of those that are counted
    bool is_hit = false;           // some fragment shows,
    bool is_last_right = false;    // and the last one may be the last of all
    Numbers in_set;                // how many of each set were there; 0 after its last member
    // Of each fragment that a later one is the twin of: 1 if it was, until the last of these.
    std::string is_there;
    friend auto operator<=>(const State&, const State&) = default;
};

// What is asked of the past of the paths that stand so, where all of them are projected.
struct Past {
    std::vector<uint64_t> hits;  // those that they have, in units of kFront and kBack, ascending
    Numbers lasts;               // which fragments showed last, ascending
    Numbers stored;              // whose depth is stored, and one, where no test asks for it
};

struct Entry {
    State state;
    Past past;
    uint32_t parent = 0;  // the entry before the last fragment, and what that did
    Deed deed = Deed::hidden;
};

// Numbers of hits that the pasts of all states have together, at most.
constexpr size_t kMostPasts = 16 * kMostStates;
constexpr uint64_t kFront = uint64_t{1} << 32U, kBack = 1;
std::pair<uint32_t, uint32_t> faces_of(uint64_t hits) {
    return {static_cast<uint32_t>(hits / kFront), static_cast<uint32_t>(hits % kFront)};
}

// Adds to an ascending list what another one has; mostly it has all of it.
template <class List>
void add_all(List& a, const List& b) {
    if (std::ranges::includes(a, b)) {
        return;
    }
    List out;
    out.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    a = std::move(out);
}

// Follows the paths side by side. Without anything observed all of them are projected: of paths
// that stand alike only their pasts are told apart, and of these only what they end in, so there
// are few, however many fragments are open.
class Search {
  public:
    // What a search is for.
    enum class For : uint8_t { projection, answer, history, lists, count };

    Search(const Question& question, For what, const Observed* observed, const Kinds* kinds)
        : question_(question),
          observed_(observed),
          kinds_(kinds),
          is_traced_(what == For::lists),
          keeps_stored_(what == For::history || question.bounds || question.depth) {
        const size_t count = question.fragments.size();
        left_.assign(question.sets.size(), 0);
        last_twin_.assign(count, -1);
        bool has_twins = false;
        for (size_t m = 0; m < count; ++m) {
            const Fragment& fragment = question.fragments[m];
            if (fragment.set >= 0) {
                ++left_[static_cast<size_t>(fragment.set)];
            }
            if (fragment.twin >= 0) {
                last_twin_[static_cast<size_t>(fragment.twin)] = static_cast<int>(m);
                has_twins = true;
            }
        }
        if (observed == nullptr) {
            out_.fates.resize(count);
            out_.is_last.assign(count, false);
            out_.is_stored.assign(count, false);
        } else {
            const auto& last = observed->last;
            const auto latest = std::find(last.rbegin(), last.rend(), true);
            latest_ = last.empty() ? count : static_cast<size_t>(last.rend() - latest);
        }
        Entry first;
        first.state.value = question.clear & kStencilBits;
        first.state.in_set.assign(question.sets.size(), 0);
        first.state.is_there.assign(has_twins ? count : 0, '\0');
        first.past.hits = {0};
        first.past.stored.assign(keeps_stored_ ? 0 : 1, 0);
        layers_.push_back({std::move(first)});
        for (uint32_t value = 0; question.is_unknown && value <= kStencilBits; ++value) {
            Entry& entry = value == 0 ? layers_.back().front()
                                      : layers_.back().emplace_back(layers_.back().front());
            entry.state.value = value;
        }
    }

    // Whether paths are left, and not too many.
    Answer run() {
        for (size_t m = 0; m < question_.fragments.size(); ++m) {
            const int set = question_.fragments[m].set;
            if (set >= 0) {
                --left_[static_cast<size_t>(set)];
            }
            const std::vector<Entry>& now = layers_.back();
            for (size_t k = 0; k < now.size(); ++k) {
                step(now[k], static_cast<uint32_t>(k), m);
            }
            if (!join()) {
                return Answer::free;
            }
        }
        std::erase_if(layers_.back(), [&](const Entry& e) { return !is_right(e.state); });
        return layers_.back().empty() ? Answer::no : Answer::yes;
    }

    Resolution projection() && {
        std::map<std::pair<uint32_t, uint32_t>, stencil::Values> outcomes;
        for (const auto& [state, past, parent, deed] : layers_.back()) {
            for (const uint64_t hits : past.hits) {
                outcomes[faces_of(hits)].set(state.value);
            }
            for (const char32_t last : past.lasts) {
                out_.is_last[last] = true;
            }
            const auto note_stored = [this](int stored) {
                if (stored == kClearDepth) {
                    out_.may_be_clear = true;
                } else {
                    out_.is_stored[static_cast<size_t>(stored)] = true;
                }
            };
            if (keeps_stored_) {
                note_stored(state.stored);
            }
            for (const char32_t stored : past.stored) {
                note_stored(static_cast<int>(stored) - 1);
            }
        }
        for (const auto& [hits, values] : outcomes) {
            out_.outcomes.push_back({hits.first, hits.second, values});
        }
        return std::move(out_);
    }

    Counted counted() const {
        const auto [least, most] = std::ranges::minmax_element(
            layers_.back(), {}, [](const Entry& e) { return e.state.counted; });
        return {least->state.counted, most->state.counted};
    }

    History history() const {
        History out;
        const Entry* entry = &layers_.back().front();
        out.stored = entry->state.stored;
        out.stencil = entry->state.value;
        for (size_t m = question_.fragments.size(); m-- > 0;) {
            if (entry->deed == Deed::discarded) {
                out.discarded.push_back(static_cast<uint32_t>(m));
            } else if (entry->deed != Deed::hidden) {
                out.shown.push_back(static_cast<uint32_t>(m));
                out.is_front.push_back(entry->deed == Deed::front);
            }
            entry = &layers_[m][entry->parent];
        }
        std::ranges::reverse(out.shown);
        std::ranges::reverse(out.discarded);
        std::reverse(out.is_front.begin(), out.is_front.end());
        return out;
    }

    std::vector<std::vector<uint32_t>> lists() const {
        std::vector<uint32_t> traces;
        for (const Entry& entry : layers_.back()) {
            traces.push_back(entry.state.trace);
        }
        std::ranges::sort(traces);
        traces.erase(std::ranges::unique(traces).begin(), traces.end());
        std::vector<std::vector<uint32_t>> out;
        for (uint32_t trace : traces) {
            std::vector<uint32_t>& list = out.emplace_back();
            for (; trace != 0; trace = traces_[trace - 1].first) {
                list.push_back(traces_[trace - 1].second);
            }
            std::ranges::reverse(list);
        }
        // As numbers whose bits are the fragments: those with the fewer late ones go first.
        std::ranges::sort(out, [](const auto& a, const auto& b) {
            return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
        });
        return out;
    }

  private:
    // Makes one of the next paths that stand alike; false if there are too many.
    bool join() {
        std::vector<uint32_t> order(next_.size());  // entries are large, their numbers are not
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, {},
                                 [this](uint32_t k) -> const State& { return next_[k].state; });
        std::vector<Entry> now;
        now.reserve(next_.size());
        size_t count = 0;
        for (const uint32_t k : order) {
            Entry& entry = next_[k];
            if (now.empty() || now.back().state != entry.state) {
                count += std::max(entry.past.hits.size(), size_t{1});
                now.push_back(std::move(entry));
            } else if (observed_ == nullptr) {
                Past& known = now.back().past;
                count -= known.hits.size();
                add_all(known.hits, entry.past.hits);
                add_all(known.lasts, entry.past.lasts);
                add_all(known.stored, entry.past.stored);
                count += known.hits.size();
            }
            if (now.size() > (is_traced_ ? kMostLists : kMostStates) || count > kMostPasts) {
                return false;
            }
        }
        next_.clear();
        layers_.push_back(std::move(now));
        if (observed_ == nullptr) {
            layers_.erase(layers_.begin());  // no history is asked
        }
        return true;
    }

    void go_on(State state, const Entry& from, uint32_t parent, Deed deed = Deed::hidden) {
        Entry entry{std::move(state), {}, parent, deed};
        if (observed_ == nullptr) {
            entry.past = from.past;
        }
        next_.push_back(std::move(entry));
    }

    // All ways for fragment m, as far as they are open.
    void step(const Entry& from, uint32_t parent, size_t m) {
        const Fragment& fragment = question_.fragments[m];
        const std::optional<bool> forced =
            fragment.twin < 0
                ? std::nullopt
                : std::optional(from.state.is_there[static_cast<size_t>(fragment.twin)] != '\0');
        if (!fragment.is_sure && !forced.value_or(false)) {
            State absent = from.state;
            if (count(absent, fragment, m, false)) {
                fate(m, [](Fate& f) { f.is_absent = true; });
                go_on(std::move(absent), from, parent);
            }
        }
        if (forced.value_or(true)) {
            State present = from.state;
            if (count(present, fragment, m, true) && is_within(present, from, parent, m)) {
                if (fragment.can_be_front) {
                    test(present, from, parent, m, true);
                }
                if (fragment.can_be_back) {
                    test(present, from, parent, m, false);
                }
            }
        }
    }

    // Notes whether fragment m is there; false if its set cannot come out.
    bool count(State& state, const Fragment& fragment, size_t m, bool is_there) {
        if (last_twin_[m] >= 0) {
            state.is_there[m] = is_there ? '\1' : '\0';
        }
        if (fragment.twin >= 0 &&
            last_twin_[static_cast<size_t>(fragment.twin)] == static_cast<int>(m)) {
            state.is_there[static_cast<size_t>(fragment.twin)] = '\0';
        }
        if (fragment.set < 0) {
            return true;
        }
        const auto k = static_cast<size_t>(fragment.set);
        const FragmentSet& set = question_.sets[k];
        char32_t& number = state.in_set[k];
        number += is_there ? 1 : 0;
        const bool fits = number <= set.most && number + left_[k] >= set.least;
        number = left_[k] > 0 ? number : 0;
        return fits;
    }

    // The depth bounds test, which leaves everything as it is where it fails: whether it may pass.
    bool is_within(const State& state, const Entry& from, uint32_t parent, size_t m) {
        const DepthOutcome bounds = question_.bounds_of(state.stored, m);
        if (bounds != DepthOutcome::passes) {
            fate(m, [](Fate& f) { f.fails_bounds = true; });
            go_on(state, from, parent);
        }
        return bounds != DepthOutcome::fails;
    }

    void test(const State& state, const Entry& from, uint32_t parent, size_t m, bool front) {
        const Fragment& fragment = question_.fragments[m];
        const cases::StencilFace& face = front ? fragment.state->front : fragment.state->back;
        fate(m, [&](Fate& f) { f.met.set(state.value); });
        State next = state;
        if (!stencil::passes(face, state.value)) {
            fate(m, [](Fate& f) { f.fails = true; });
            next.value = stencil::updated(face.fail, face, state.value);
            go_on(std::move(next), from, parent);
            return;
        }
        const DepthOutcome depth = question_.depth_of(state.stored, m);
        if (depth != DepthOutcome::passes) {
            fate(m, [](Fate& f) { f.fails_depth = true; });
            next.value = stencil::updated(face.depth_fail, face, state.value);
            go_on(next, from, parent);
        }
        if (depth == DepthOutcome::fails) {
            return;
        }
        const bool is_discarded = front ? fragment.is_discarded_front : fragment.is_discarded_back;
        next.value = stencil::updated(face.pass, face, state.value);
        store(next, fragment, m);
        if (is_discarded || fragment.is_discard_open) {
            fate(m, [](Fate& f) { f.is_discarded = true; });
            State discarded = next;
            discarded.counted += is_counted(m) && observed_->counting->with_discarded ? 1U : 0U;
            if (fragment.is_clear) {
                trace(discarded, m);
            }
            go_on(std::move(discarded), from, parent, Deed::discarded);
            store_past(fragment, m);
        }
        if (!is_discarded || fragment.is_discard_open) {
            fate(m, [](Fate& f) { f.passes = true; });
            show(std::move(next), from, parent, m, front);
        }
    }

    void store(State& state, const Fragment& fragment, size_t m) const {
        if (!fragment.writes_depth) {
            return;
        }
        if (keeps_stored_) {
            state.stored = static_cast<int>(m);
        } else if (observed_ != nullptr && !observed_->stored.empty()) {
            state.stored = observed_->stored[m] ? kRightDepth : kWrongDepth;
        }
    }

    // The same in the past of the path that was followed last, where no state has it.
    void store_past(const Fragment& fragment, size_t m) {
        if (fragment.writes_depth && observed_ == nullptr && !keeps_stored_) {
            next_.back().past.stored.assign(1, static_cast<char32_t>(m + 1));
        }
    }

    void show(State state, const Entry& from, uint32_t parent, size_t m, bool front) {
        if (observed_ == nullptr) {
            go_on(std::move(state), from, parent);
            Past& past = next_.back().past;
            for (uint64_t& hits : past.hits) {
                hits += front ? kFront : kBack;
            }
            past.lasts.assign(1, static_cast<char32_t>(m));
            store_past(question_.fragments[m], m);
            return;
        }
        using enum SeenHits::Detail;
        const SeenHits& seen = observed_->hits;
        if (seen.detail >= total) {
            ++(front || seen.detail == total ? state.front : state.back);
            if (state.front > seen.front || state.back > seen.back) {
                return;
            }
        }
        state.counted += is_counted(m) ? 1U : 0U;
        state.is_hit = true;
        state.is_last_right = observed_->last.empty() || observed_->last[m];
        if (!state.is_last_right && m >= latest_) {
            return;
        }
        trace(state, m);
        go_on(std::move(state), from, parent, front ? Deed::front : Deed::back);
    }

    void trace(State& state, size_t m) {
        if (is_traced_) {
            const bool replaces = kinds_ != nullptr && kinds_->replaces[m];
            state.trace = trace_of(replaces ? 0 : state.trace,
                                   kinds_ != nullptr ? kinds_->kind[m] : static_cast<uint32_t>(m));
        }
    }

    bool is_counted(size_t m) const {
        return observed_ != nullptr && observed_->counting && observed_->counting->of[m];
    }

    // The number of a list of fragments, and one more.
    uint32_t trace_of(uint32_t before, uint32_t fragment) {
        const auto [at, is_new] = numbers_.try_emplace(std::pair(before, fragment),
                                                       static_cast<uint32_t>(traces_.size() + 1));
        if (is_new) {
            traces_.emplace_back(before, fragment);
        }
        return at->second;
    }

    // Whether what was observed allows how a path ends.
    bool is_right(const State& state) const {
        if (observed_ == nullptr) {
            return true;
        }
        using enum SeenHits::Detail;
        const SeenHits& seen = observed_->hits;
        const bool has_hits = seen.detail == none ? true
                              : seen.detail == any
                                  ? state.is_hit == (seen.front > 0)
                                  : state.front == seen.front && state.back == seen.back;
        const bool has_last = state.is_hit ? state.is_last_right : observed_->may_be_unhit;
        const bool has_depth =
            observed_->stored.empty()     ? state.stored != kClearDepth || observed_->may_be_clear
            : state.stored == kClearDepth ? observed_->may_be_clear
            : keeps_stored_               ? observed_->stored[static_cast<size_t>(state.stored)]
                                          : state.stored == kRightDepth;
        const bool has_count = !observed_->counting || !observed_->counting->number ||
                               state.counted == *observed_->counting->number;
        return has_hits && has_last && has_depth && has_count &&
               (!observed_->stencil || *observed_->stencil == state.value);
    }

    template <class Note>
    void fate(size_t m, Note note) {
        if (observed_ == nullptr) {
            note(out_.fates[m]);
        }
    }

    // Where no test asks whose depth is stored: whether it is one that may be observed.
    static constexpr int kRightDepth = 0, kWrongDepth = 1;

    const Question& question_;
    const Observed* observed_;  // null: all paths are projected
    const Kinds* kinds_;        // null: every fragment is of a kind of its own and replaces nothing
    bool is_traced_;
    bool keeps_stored_;
    size_t latest_ = 0;  // the last fragment that may be the last to show, and one
    Resolution out_;
    std::vector<std::vector<Entry>> layers_;  // after each fragment; of projections the last alone
    std::vector<Entry> next_;
    std::vector<uint32_t> left_;  // members of each set that are still to come
    std::vector<int> last_twin_;  // the last fragment whose twin this one is, or -1
    std::vector<std::pair<uint32_t, uint32_t>> traces_;  // from 1: the list before, a fragment
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> numbers_;
};

}  // namespace

Resolution resolve(const Question& question) {
    if (std::optional<Resolution> certain = resolve_certain(question)) {
        return std::move(*certain);
    }
    Search search(question, Search::For::projection, nullptr, nullptr);
    const Answer answer = search.run();
    Resolution out = std::move(search).projection();
    out.is_free = answer != Answer::yes;
    return out;
}

Answer has_path(const Question& question, const Observed& observed) {
    return Search(question, Search::For::answer, &observed, nullptr).run();
}

std::optional<History> find_path(const Question& question, const Observed& observed) {
    Search search(question, Search::For::history, &observed, nullptr);
    return search.run() == Answer::yes ? std::optional(search.history()) : std::nullopt;
}

Shown shown_by(const Question& question, const Observed& observed, const Kinds* kinds) {
    Search search(question, Search::For::lists, &observed, kinds);
    const Answer answer = search.run();
    return {answer == Answer::free,
            answer == Answer::yes ? search.lists() : std::vector<std::vector<uint32_t>>()};
}

std::optional<Counted> counted_by(const Question& question, const Observed& observed) {
    Search search(question, Search::For::count, &observed, nullptr);
    return search.run() == Answer::yes ? std::optional(search.counted()) : std::nullopt;
}

stencil::Values values_of(std::span<const Outcome> outcomes, bool is_free, uint32_t clear,
                          const std::optional<std::pair<uint32_t, uint32_t>>& hits) {
    stencil::Values out;
    const auto fits = [&](const Outcome& o) {
        return hits && o.front == hits->first && o.back == hits->second;
    };
    const bool is_known = std::ranges::any_of(outcomes, fits);
    for (const Outcome& o : outcomes) {
        if (!is_known || fits(o)) {
            out |= o.values;
        }
    }
    if (is_free) {
        out.set();
    } else if (outcomes.empty()) {
        out.set(clear);
    }
    return out;
}

}  // namespace ref::path
