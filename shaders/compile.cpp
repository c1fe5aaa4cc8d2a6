// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// compile_shader SOURCE VARIANTS OUTPUT, at build time: compiles SOURCE (GLSL; the end of its name
// says the stage) once a variant and writes all modules to OUTPUT as C++ arrays. Each line of
// VARIANTS is a variant: the array's name, 1.1 or 1.2 (the Vulkan version whose SPIR-V it is: 1.3
// or 1.5), then its definitions as NAME=VALUE. One process for all, because glslang reads its own
// built-in declarations for 0.1 s first, fifteen times what a variant takes.
#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/ResourceLimits.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {
std::string content_of(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    if (!file) {
        throw std::runtime_error(std::string(path) + " cannot be read");
    }
    return text.str();
}

glslang_stage_t stage_of(const std::filesystem::path& source) {
    static const std::map<std::string, glslang_stage_t> kStages{
        {".vert", GLSLANG_STAGE_VERTEX},
        {".frag", GLSLANG_STAGE_FRAGMENT},
        {".geom", GLSLANG_STAGE_GEOMETRY},
        {".tesc", GLSLANG_STAGE_TESSCONTROL},
        {".tese", GLSLANG_STAGE_TESSEVALUATION},
        {".comp", GLSLANG_STAGE_COMPUTE},
        {".mesh", GLSLANG_STAGE_MESH}};
    const auto found = kStages.find(source.extension().string());
    if (found == kStages.end()) {
        throw std::runtime_error(source.string() + " names no stage");
    }
    return found->second;
}

struct Variant {
    std::string name;
    bool is_of_vulkan_12 = false;
    std::string preamble;  // its definitions, before the source's first line after #version
};

std::vector<Variant> variants_of(const char* path) {
    std::vector<Variant> variants;
    std::stringstream lines(content_of(path));
    for (std::string line; std::getline(lines, line);) {
        std::stringstream words(line);
        Variant variant;
        std::string word;
        words >> variant.name >> word;
        variant.is_of_vulkan_12 = word == "1.2";
        while (words >> word) {
            const size_t equals = word.find('=');
            if (equals == std::string::npos) {
                throw std::runtime_error(word + " of " + variant.name +
                                         " is no definition NAME=VALUE");
            }
            variant.preamble +=
                "#define " + word.substr(0, equals) + " " + word.substr(equals + 1) + "\n";
        }
        variants.push_back(variant);
    }
    return variants;
}

std::vector<uint32_t> compiled(const std::string& code, glslang_stage_t stage,
                               const Variant& variant) {
    glslang_input_t input{};
    input.language = GLSLANG_SOURCE_GLSL;
    input.stage = stage;
    input.client = GLSLANG_CLIENT_VULKAN;
    input.client_version =
        variant.is_of_vulkan_12 ? GLSLANG_TARGET_VULKAN_1_2 : GLSLANG_TARGET_VULKAN_1_1;
    input.target_language = GLSLANG_TARGET_SPV;
    input.target_language_version =
        variant.is_of_vulkan_12 ? GLSLANG_TARGET_SPV_1_5 : GLSLANG_TARGET_SPV_1_3;
    input.code = code.c_str();
    input.default_version = 100;
    input.default_profile = GLSLANG_NO_PROFILE;
    input.messages =
        static_cast<glslang_messages_t>(GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT);
    // The C++ structure is the C one, member by member; Debian 12's library lacks the function that
    // returns the latter.
    input.resource = reinterpret_cast<const glslang_resource_t*>(GetDefaultResources());
    glslang_shader_t* shader = glslang_shader_create(&input);
    glslang_shader_set_preamble(shader, variant.preamble.c_str());
    glslang_program_t* program = glslang_program_create();
    std::string wrong;
    std::vector<uint32_t> module;
    if (glslang_shader_preprocess(shader, &input) == 0 ||
        glslang_shader_parse(shader, &input) == 0) {
        wrong = glslang_shader_get_info_log(shader);
    } else {
        glslang_program_add_shader(program, shader);
        if (glslang_program_link(program, input.messages) == 0) {
            wrong = glslang_program_get_info_log(program);
        } else {
            glslang_spv_options_t options{};
            options.strip_debug_info = true;
            options.disable_optimizer = true;
            glslang_program_SPIRV_generate_with_options(program, stage, &options);
            const char* messages = glslang_program_SPIRV_get_messages(program);
            wrong = messages == nullptr ? "" : messages;
            module.resize(glslang_program_SPIRV_get_size(program));
            glslang_program_SPIRV_get(program, module.data());
        }
    }
    glslang_program_delete(program);
    glslang_shader_delete(shader);
    if (module.empty() || !wrong.empty()) {
        throw std::runtime_error("glslang rejects it with\n" + variant.preamble + wrong);
    }
    return module;
}

void compile(const char* source, const char* variants, const char* output) {
    const std::string code = content_of(source);
    const std::filesystem::path path(source);
    std::string text = "// Made from " + path.filename().string() + " by glslang; do not edit.\n";
    for (const Variant& variant : variants_of(variants)) {
        text += "constexpr uint32_t " + variant.name + "[] = {";
        char word[16];
        for (const uint32_t value : compiled(code, stage_of(path), variant)) {
            std::snprintf(word, sizeof word, "%#x,", value);
            text += word;
        }
        text += "};\n";
    }
    std::ofstream file(output, std::ios::binary);
    if (!(file << text).flush()) {
        throw std::runtime_error(std::string(output) + " cannot be written");
    }
}
}  // namespace

int main(int count, char** words) {
    if (count != 4) {
        std::fprintf(stderr, "usage: compile_shader SOURCE VARIANTS OUTPUT\n");
        return 2;
    }
    glslang_initialize_process();
    int code = 0;
    try {
        compile(words[1], words[2], words[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", words[1], error.what());
        code = 1;
    }
    glslang_finalize_process();
    return code;
}
