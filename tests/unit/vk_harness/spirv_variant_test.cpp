// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
#include "shaders/spirv_variant.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "shaders/shaders.hpp"
#include "vk_harness/pipeline/pipeline_key.hpp"
#include "vk_harness/pipeline/shader_stage.hpp"

namespace vk_harness {
namespace {

using Words = std::vector<uint32_t>;

// A module of instructions, each without its first word.
class Assembler {
  public:
    Assembler& add(uint32_t op, const Words& operands) {
        words_.push_back(static_cast<uint32_t>(operands.size() + 1) << 16U | op);
        words_.insert(words_.end(), operands.begin(), operands.end());
        return *this;
    }
    const Words& words() const { return words_; }

  private:
    Words words_ = {0x07230203, 0x00010300, 0, 10, 0};
};

constexpr uint32_t kCapability = 17, kVariable = 59, kDecorate = 71, kGroup = 73;
constexpr uint32_t kInput = 1, kOutput = 3;

// Input 5 and output 6 at location 2.
Assembler small_module() {
    Assembler a;
    a.add(kCapability, {1}).add(kDecorate, {5, 30, 2}).add(kDecorate, {6, 30, 2});
    return a.add(kVariable, {1, 5, kInput}).add(kVariable, {1, 6, kOutput});
}

shaders::InputChange at_location(uint32_t location) {
    shaders::InputChange change;
    change.number = location;
    return change;
}

std::string error_of(const Words& module, const std::vector<shaders::InputChange>& changes) {
    const auto made = shaders::change_inputs(module, changes);
    return made ? "" : made.error();
}

TEST(SpirvVariant, DecoratesTheInputAndNotTheOutput) {
    shaders::InputChange change = at_location(2);
    change.no_perspective = true;
    const auto made = shaders::change_inputs(small_module().words(), {{change}});
    ASSERT_TRUE(made) << made.error();
    Assembler want;
    want.add(kCapability, {1}).add(kDecorate, {5, 30, 2}).add(kDecorate, {5, 13});
    want.add(kDecorate, {6, 30, 2}).add(kVariable, {1, 5, kInput}).add(kVariable, {1, 6, kOutput});
    EXPECT_EQ(*made, want.words());
}

TEST(SpirvVariant, NoChangesGiveTheModuleItself) {
    const auto made = shaders::change_inputs(small_module().words(), {});
    ASSERT_TRUE(made);
    EXPECT_EQ(*made, small_module().words());
}

TEST(SpirvVariant, SampleBringsItsCapabilityOnce) {
    shaders::InputChange change = at_location(2);
    change.sample = true;
    const auto made = shaders::change_inputs(small_module().words(), {{change}});
    ASSERT_TRUE(made);
    EXPECT_THAT(Words(made->begin() + 5, made->begin() + 9),
                ::testing::ElementsAre(2U << 16U | kCapability, 35, 2U << 16U | kCapability, 1));
    Assembler has_it;
    has_it.add(kCapability, {35}).add(kDecorate, {5, 30, 2}).add(kVariable, {1, 5, kInput});
    const auto again = shaders::change_inputs(has_it.words(), {{change}});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->size(), has_it.words().size() + 3);  // the decoration alone
}

TEST(SpirvVariant, PrimitiveIdTakesThePlaceOfTheLocation) {
    shaders::InputChange change = at_location(2);
    change.becomes_primitive_id = true;
    const auto made = shaders::change_inputs(small_module().words(), {{change}});
    ASSERT_TRUE(made);
    Assembler want;
    want.add(kCapability, {2}).add(kCapability, {1}).add(kDecorate, {5, 11, 7});
    want.add(kDecorate, {6, 30, 2}).add(kVariable, {1, 5, kInput}).add(kVariable, {1, 6, kOutput});
    EXPECT_EQ(*made, want.words());
}

TEST(SpirvVariant, WhatItRefuses) {
    const shaders::InputChange change = at_location(2);
    const Words good = small_module().words();
    EXPECT_EQ(error_of({}, {}), "the module does not begin as SPIR-V of this machine's byte order");
    Words bad = good;
    bad[0] = 0x03022307;
    EXPECT_EQ(error_of(bad, {}),
              "the module does not begin as SPIR-V of this machine's byte order");
    bad = good;
    bad[1] = 0x00010700;
    EXPECT_EQ(error_of(bad, {}), "the module's version 0x00010700 is not 1.0 to 1.6");
    bad = good;
    bad[4] = 1;
    EXPECT_EQ(error_of(bad, {}), "the module's schema is not 0");
    bad = good;
    bad[5] = 17;  // length 0
    EXPECT_EQ(error_of(bad, {}), "the instruction at word 5 runs over the module's end");
    bad = good;
    bad.pop_back();
    EXPECT_EQ(error_of(bad, {}), "the instruction at word " + std::to_string(good.size() - 4) +
                                     " runs over the module's end");
    bad = good;
    bad.insert(bad.end(), {2U << 16U | kDecorate, 5});
    EXPECT_EQ(error_of(bad, {}),
              "the instruction at word " + std::to_string(good.size()) + " is too short");
    EXPECT_EQ(error_of(Assembler(small_module()).add(kGroup, {9}).words(), {}),
              "the module has decoration groups");
    EXPECT_EQ(error_of(good, {at_location(3)}), "no input of the module has location 3");
    Assembler two = small_module();
    two.add(kDecorate, {7, 30, 2}).add(kVariable, {1, 7, kInput});
    EXPECT_EQ(error_of(two.words(), {change}), "two inputs of the module have location 2");
    EXPECT_EQ(error_of(good, {change, change}), "input 2 is changed twice");
    shaders::InputChange built_in;
    built_in.by = shaders::InputBy::built_in;
    built_in.number = shaders::kBuiltInBaryCoord;
    EXPECT_EQ(error_of(good, {built_in}), "no input of the module has built-in 5286");
}

constexpr uint32_t kExtension = 10, kKill = 252, kReturn = 253;

// What ends the invocation, by word: the name of the extension is in the module's own byte order.
TEST(SpirvVariant, AnotherInstructionDiscards) {
    const Words module = Assembler().add(kCapability, {1}).add(14, {0, 1}).add(kKill, {}).words();
    const auto name = [](const char* text, size_t words) {
        Words out(words);
        std::memcpy(out.data(), text, std::strlen(text));
        return out;
    };
    EXPECT_EQ(shaders::with_ending(module, shaders::Ending::kill).value(), module);
    EXPECT_EQ(shaders::with_ending(module, shaders::Ending::demote).value(),
              Assembler()
                  .add(kCapability, {5379})
                  .add(kCapability, {1})
                  .add(kExtension, name("SPV_EXT_demote_to_helper_invocation", 9))
                  .add(14, {0, 1})
                  .add(5380, {})
                  .add(kReturn, {})
                  .words());
    EXPECT_EQ(shaders::with_ending(module, shaders::Ending::terminate).value(),
              Assembler()
                  .add(kCapability, {1})
                  .add(kExtension, name("SPV_KHR_terminate_invocation", 8))
                  .add(14, {0, 1})
                  .add(4416, {})
                  .words());
    const auto plain = shaders::with_ending(small_module().words(), shaders::Ending::demote);
    ASSERT_FALSE(plain);
    EXPECT_EQ(plain.error(), "the module discards nothing");
}

TEST(SpirvVariant, ContradictionsAreRefused) {
    shaders::InputChange change = at_location(2);
    change.flat = true;
    change.centroid = true;
    EXPECT_EQ(error_of(small_module().words(), {change}),
              "the decorations of input 2 contradict each other");
    change.flat = false;
    change.sample = true;
    EXPECT_EQ(error_of(small_module().words(), {change}),
              "the decorations of input 2 contradict each other");
    Assembler flat = small_module();
    flat.add(kDecorate, {5, 14});
    change = at_location(2);
    change.no_perspective = true;
    EXPECT_EQ(error_of(flat.words(), {change}), "the decorations of input 2 contradict each other");
    change.no_perspective = false;
    change.flat = true;
    EXPECT_EQ(error_of(flat.words(), {change}), "input 2 has decoration 14 already");
}

// What spirv-val says to a module; empty if it is content.
std::string validator_says(std::span<const uint32_t> module) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("edgecase-spirv-" + std::to_string(::getpid()) + ".spv");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(module.data()),
               static_cast<std::streamsize>(module.size_bytes()));
    std::FILE* pipe =
        ::popen(("spirv-val --target-env vulkan1.3 " + file.string() + " 2>&1").c_str(), "r");
    std::string said;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
        said += static_cast<char>(c);
    }
    const int status = ::pclose(pipe);
    std::filesystem::remove(file);
    return status == 0 && said.empty() ? "" : "spirv-val: " + said;
}

TEST(SpirvVariant, TheValidatorSpeaksOfABrokenModule) {
    EXPECT_THAT(validator_says(small_module().words()), ::testing::HasSubstr("spirv-val: error"));
}

TEST(SpirvVariant, EveryEmbeddedModuleIsValid) {
    size_t count = 0;
    for (; !shaders::any_module(count).empty(); ++count) {
        EXPECT_EQ(validator_says(shaders::any_module(count)), "") << "module " << count;
    }
    EXPECT_GE(count, 200U);
}

TEST(SpirvVariant, AnUnusedOutputIsAdded) {
    for (const std::span<const uint32_t> code :
         {shaders::capture_vertex({}), shaders::capture_vertex({2, 1, 0, false, false, true}),
          shaders::capture_fragment({}), shaders::clear_depth()}) {
        auto once = shaders::with_unused_output(code, 8);
        ASSERT_TRUE(once) << once.error();
        EXPECT_EQ(validator_says(*once), "");
        const auto twice = shaders::with_unused_output(*once, 13);
        ASSERT_TRUE(twice) << twice.error();
        EXPECT_EQ(validator_says(*twice), "");
        const auto again = shaders::with_unused_output(*once, 8);
        ASSERT_FALSE(again);
        EXPECT_EQ(again.error(), "the module has an output at location 8");
    }
    EXPECT_FALSE(shaders::with_unused_output(small_module().words(), 8));
}

TEST(SpirvVariant, TheSubpassInputIsRenumbered) {
    for (const bool is_integer : {false, true}) {
        for (const bool has_samples : {false, true}) {
            const auto code = shaders::read_input(is_integer, has_samples);
            const auto changed = shaders::with_input_index(code, 5);
            ASSERT_TRUE(changed) << changed.error();
            EXPECT_EQ(validator_says(*changed), "");
            EXPECT_EQ(changed->size(), code.size());
            size_t differing = 0;
            for (size_t k = 0; k < code.size(); ++k) {
                differing += (*changed)[k] != code[k] ? 1U : 0U;
            }
            EXPECT_EQ(differing, 1U);
        }
    }
    const auto none = shaders::with_input_index(shaders::clear_vertex(), 5);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error(), "the module has 0 subpass inputs");
}

// Every interpolation with every auxiliary qualifier, on devices with and without primitive ids.
TEST(SpirvVariant, EveryChangedModuleIsValid) {
    using cases::Auxiliary;
    using cases::Interpolation;
    for (const bool primitive_id : {false, true}) {
        for (const cases::Source source : {cases::Source::vertex, cases::Source::barycentric}) {
            for (const auto interpolation :
                 {Interpolation::smooth, Interpolation::noperspective, Interpolation::flat}) {
                for (const auto auxiliary :
                     {Auxiliary::none, Auxiliary::centroid, Auxiliary::sample}) {
                    if (interpolation == Interpolation::flat &&
                        (auxiliary != Auxiliary::none || source != cases::Source::vertex)) {
                        continue;
                    }
                    PipelineKey key;
                    key.attribute_count = 2;
                    key.attributes[1].interpolation = interpolation;
                    key.attributes[1].auxiliary = auxiliary;
                    key.attributes[1].source = source;
                    const auto code = shaders::capture_fragment(fragment_variant(key));
                    ASSERT_FALSE(code.empty());
                    const auto changed =
                        shaders::change_inputs(code, input_changes(key, primitive_id));
                    ASSERT_TRUE(changed) << changed.error();
                    EXPECT_EQ(validator_says(*changed), "");
                }
            }
        }
    }
}

TEST(SpirvVariant, EveryOtherEndingIsValid) {
    PipelineKey key;
    key.discards = true;
    const auto code = shaders::capture_fragment(fragment_variant(key));
    ASSERT_FALSE(code.empty());
    for (const auto ending : {shaders::Ending::demote, shaders::Ending::terminate}) {
        const auto changed = shaders::with_ending(code, ending);
        ASSERT_TRUE(changed) << changed.error();
        EXPECT_NE(*changed, std::vector<uint32_t>(code.begin(), code.end()));
        EXPECT_EQ(validator_says(*changed), "");
    }
}

// Of two colours from location 4 on, at 4 to 9, the first keeps its integers and the second its
// signed ones; that at 3 is an output of another.
TEST(SpirvVariant, OutputsThatAreLeftOutBecomePrivate) {
    constexpr uint32_t kEntry = 15, kPointer = 32, kPrivate = 6;
    const Words name = {0x6e69616d, 0};  // "main"
    Assembler a;
    a.add(kCapability, {1}).add(kEntry, {4, 1, name[0], name[1], 5, 6, 7, 8, 9, 10, 11});
    for (uint32_t k = 0; k < 7; ++k) {
        a.add(kDecorate, {5 + k, 30, 3 + k});
    }
    a.add(kPointer, {3, kOutput, 2});
    for (uint32_t k = 0; k < 7; ++k) {
        a.add(kVariable, {3, 5 + k, kOutput});
    }
    using enum shaders::Output;
    Words module = a.words();
    module[3] = 12;
    const auto made = shaders::with_outputs(module, {4, {whole, signed_whole}});
    ASSERT_TRUE(made) << made.error();
    Assembler want;
    want.add(kCapability, {1}).add(kEntry, {4, 1, name[0], name[1], 5, 7, 11});
    want.add(kDecorate, {5, 30, 3}).add(kDecorate, {7, 30, 4}).add(kDecorate, {11, 30, 5});
    want.add(kPointer, {3, kOutput, 2}).add(kVariable, {3, 5, kOutput});
    want.add(kPointer, {12, kPrivate, 2}).add(kVariable, {12, 6, kPrivate});
    want.add(kVariable, {3, 7, kOutput}).add(kVariable, {12, 8, kPrivate});
    want.add(kVariable, {12, 9, kPrivate}).add(kVariable, {12, 10, kPrivate});
    want.add(kVariable, {3, 11, kOutput});
    Words words = want.words();
    words[3] = 13;  // one id more
    EXPECT_EQ(*made, words);
    EXPECT_EQ(shaders::with_outputs(a.words(), {}).value(), a.words());
    const auto missing = shaders::with_outputs(a.words(), {4, {whole, whole, number}});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error(), "no output of the module has location 10");
}

// Every choice of two to four outputs, with the instruments in both layouts and without.
TEST(SpirvVariant, EveryChoiceOfOutputsIsValid) {
    for (const bool instruments : {true, false}) {
        for (const bool split : {true, false}) {
            PipelineKey key;
            key.attribute_count = 1;
            key.instruments = instruments;
            key.layout.split = split && instruments;
            key.color = shaders::ColorKind::several;
            for (uint32_t count = 2; count <= shaders::kMaxColors; ++count) {
                for (uint32_t choice = 0; choice < 3U * 3U * 3U * 3U; ++choice) {
                    key.colors.assign(count, {});
                    for (uint32_t k = 0, rest = choice; k < count; ++k, rest /= 3) {
                        key.colors[k].output = static_cast<shaders::Output>(rest % 3);
                    }
                    const auto code = shaders::capture_fragment(fragment_variant(key));
                    ASSERT_FALSE(code.empty());
                    const shaders::OutputChange change = output_change(key);
                    EXPECT_EQ(change.first_location, !instruments ? 0U : split ? 5U : 3U);
                    const auto changed = shaders::with_outputs(code, change);
                    ASSERT_TRUE(changed) << changed.error();
                    EXPECT_EQ(validator_says(*changed), "");
                }
            }
        }
    }
}

}  // namespace
}  // namespace vk_harness
