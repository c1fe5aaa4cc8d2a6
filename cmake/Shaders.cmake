# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# edgecase_shaders: every variant of the shaders in shaders/, compiled by glslang at build time and embedded.
# A build for another machine takes the compile_shader of one for this: EDGECASE_COMPILE_SHADER is its path.
set(EDGECASE_COMPILE_SHADER "" CACHE FILEPATH "compile_shader of another build; without it, it is built of glslang")
set(EDGECASE_SHADER_DIR ${CMAKE_BINARY_DIR}/shaders)
file(MAKE_DIRECTORY ${EDGECASE_SHADER_DIR})
if(EDGECASE_COMPILE_SHADER)
    add_executable(compile_shader IMPORTED)
    set_target_properties(compile_shader PROPERTIES IMPORTED_LOCATION ${EDGECASE_COMPILE_SHADER})
else()
    find_package(glslang CONFIG REQUIRED)
    add_executable(compile_shader ${CMAKE_SOURCE_DIR}/shaders/compile.cpp)
    target_link_libraries(compile_shader PRIVATE glslang::SPIRV glslang::glslang
                          glslang::glslang-default-resource-limits edgecase_warnings)
endif()

set(EDGECASE_SHADER_OUTPUTS "")
set(EDGECASE_SHADER_INCLUDES "")
# The variants are a list; each is a line that shaders/compile.cpp reads.
function(edgecase_compile_shader source output variants)
    set(path ${EDGECASE_SHADER_DIR}/${output}.inc)
    list(JOIN variants "\n" lines)
    file(CONFIGURE OUTPUT ${EDGECASE_SHADER_DIR}/${output}.txt CONTENT "${lines}\n")
    add_custom_command(
        OUTPUT ${path}
        COMMAND compile_shader ${CMAKE_SOURCE_DIR}/shaders/${source} ${EDGECASE_SHADER_DIR}/${output}.txt ${path}
        DEPENDS compile_shader ${CMAKE_SOURCE_DIR}/shaders/${source} ${EDGECASE_SHADER_DIR}/${output}.txt
        COMMENT "Compiling ${source} (${output})"
        VERBATIM)
    set(EDGECASE_SHADER_OUTPUTS ${EDGECASE_SHADER_OUTPUTS} ${path} PARENT_SCOPE)
    set(EDGECASE_SHADER_INCLUDES "${EDGECASE_SHADER_INCLUDES}#include \"${output}.inc\"\n" PARENT_SCOPE)
endfunction()

edgecase_compile_shader(copy_samples.comp copy
    "copy_depth 1.1 DEPTH=1;copy_codes 1.1 DEPTH=2;copy_1 1.1 DEPTH=0 WORDS=1;copy_2 1.1 DEPTH=0 WORDS=2;copy_4 1.1 DEPTH=0 WORDS=4;copy_unorm 1.1 DEPTH=0 WORDS=1 UNORM=1")

# A triangle that clears, one shader for each place that it clears: KIND 0 depth, 1 a colour of numbers, 2 one of integers, 3 one
# of signed ones.
edgecase_compile_shader(clear.vert clear_vertex "over_target 1.1")
set(clear_variants "write_depth 1.1 KIND=0 LOCATION=0")
foreach(location RANGE 15)
    list(APPEND clear_variants "clear_number_${location} 1.1 KIND=1 LOCATION=${location}"
                               "clear_integer_${location} 1.1 KIND=2 LOCATION=${location}"
                               "clear_signed_${location} 1.1 KIND=3 LOCATION=${location}")
    list(APPEND clear_colors clear_number_${location} clear_integer_${location} clear_signed_${location})
endforeach()
edgecase_compile_shader(clear.frag clear_fragment "${clear_variants}")
list(JOIN clear_colors ", " clear_colors)

edgecase_compile_shader(bare.frag bare
    "bare_constant 1.1 FROM=1;bare_uniform 1.1 FROM=2;bare_offset 1.1 FROM=3;bare_storage 1.1 FROM=4;bare_texture 1.1 FROM=5;bare_mask 1.1 FROM=6")

# Vertex shaders: attributes x (clip x cull distances without routing, and routing without distances).
# Each row of a table is a variant: what it was compiled for, then its words.
set(vertex_table "")
foreach(count RANGE 4)
    set(variants "")
    foreach(clip RANGE 4)
        foreach(cull RANGE 4)
            set(name vertex_${count}_${clip}_${cull}_0_0)
            list(APPEND variants "${name} 1.1 ATTRIBUTES=${count} CLIP=${clip} CULL=${cull} LAYER=0 VIEWPORT=0 PULLED=0 INSTANCED=0")
            string(APPEND vertex_table "    {{${count}, ${clip}, ${cull}, false, false, false, Instances::one}, ${name}},\n")
            if(clip EQUAL 0 OR cull EQUAL 0)
                set(distances "1.1 ATTRIBUTES=${count} CLIP=${clip} CULL=${cull} LAYER=0 VIEWPORT=0")
                list(APPEND variants "${name}_pulled ${distances} PULLED=1 INSTANCED=0"
                                     "${name}_shown ${distances} PULLED=0 INSTANCED=1"
                                     "${name}_placed ${distances} PULLED=0 INSTANCED=2")
                string(APPEND vertex_table
                       "    {{${count}, ${clip}, ${cull}, false, false, true, Instances::one}, ${name}_pulled},\n"
                       "    {{${count}, ${clip}, ${cull}, false, false, false, Instances::shown}, ${name}_shown},\n"
                       "    {{${count}, ${clip}, ${cull}, false, false, false, Instances::placed}, ${name}_placed},\n")
            endif()
        endforeach()
    endforeach()
    edgecase_compile_shader(capture.vert vertex_${count} "${variants}")
    set(variants "")
    foreach(routing "1;0" "0;1" "1;1")
        list(GET routing 0 layer)
        list(GET routing 1 viewport)
        set(name vertex_${count}_0_0_${layer}_${viewport})
        # gl_Layer and gl_ViewportIndex as in Vulkan 1.2: capabilities of SPIR-V 1.5, no extension.
        set(routed "1.2 ATTRIBUTES=${count} CLIP=0 CULL=0 LAYER=${layer} VIEWPORT=${viewport}")
        list(APPEND variants "${name} ${routed} PULLED=0 INSTANCED=0" "${name}_pulled ${routed} PULLED=1 INSTANCED=0"
                             "${name}_shown ${routed} PULLED=0 INSTANCED=1"
                             "${name}_placed ${routed} PULLED=0 INSTANCED=2")
        string(APPEND vertex_table "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, false, Instances::one}, ${name}},\n"
                                   "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, true, Instances::one}, ${name}_pulled},\n"
                                   "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, false, Instances::shown}, ${name}_shown},\n"
                                   "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, false, Instances::placed}, ${name}_placed},\n")
    endforeach()
    edgecase_compile_shader(capture.vert vertex_routed_${count} "${variants}")
endforeach()

# Positions that are multiplied by a matrix, for fragment shaders of bare.frag.
set(matrix_keys "CLIP=0 CULL=0 LAYER=0 VIEWPORT=0 PULLED=0 INSTANCED=0 MATRIX=1")
edgecase_compile_shader(capture.vert vertex_matrix
    "vertex_matrix_0 1.1 ATTRIBUTES=0 ${matrix_keys};vertex_matrix_1 1.1 ATTRIBUTES=1 ${matrix_keys}")

# Input attachments that are read: of integers or not, of several samples or one.
edgecase_compile_shader(input.frag input
    "input_number 1.1 WHOLE=0 SAMPLES=0;input_numbers 1.1 WHOLE=0 SAMPLES=1;input_whole 1.1 WHOLE=1 SAMPLES=0;input_wholes 1.1 WHOLE=1 SAMPLES=1")

# Stages that hand triangles on: a geometry or mesh shader with clip or cull distances, or with routing; tessellation
# without.
set(geometry_table "")
set(mesh_table "")
set(control_names "")
set(evaluation_names "")
foreach(count RANGE 4)
    set(variants "")
    set(mesh_variants "")
    foreach(distances "0;0" "1;0" "2;0" "3;0" "4;0" "0;1" "0;2" "0;3" "0;4")
        list(GET distances 0 clip)
        list(GET distances 1 cull)
        set(name geometry_${count}_${clip}_${cull}_0_0)
        list(APPEND variants "${name} 1.1 ATTRIBUTES=${count} CLIP=${clip} CULL=${cull} LAYER=0 VIEWPORT=0")
        string(APPEND geometry_table "    {{${count}, ${clip}, ${cull}, false, false, false}, ${name}},\n")
        list(APPEND mesh_variants "mesh_${name} 1.2 ATTRIBUTES=${count} CLIP=${clip} CULL=${cull} LAYER=0 VIEWPORT=0")
        string(APPEND mesh_table "    {{${count}, ${clip}, ${cull}, false, false, false}, mesh_${name}},\n")
    endforeach()
    foreach(routing "1;0" "0;1" "1;1")
        list(GET routing 0 layer)
        list(GET routing 1 viewport)
        set(name geometry_${count}_0_0_${layer}_${viewport})
        list(APPEND variants "${name} 1.1 ATTRIBUTES=${count} CLIP=0 CULL=0 LAYER=${layer} VIEWPORT=${viewport}")
        string(APPEND geometry_table "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, false}, ${name}},\n")
        list(APPEND mesh_variants "mesh_${name} 1.2 ATTRIBUTES=${count} CLIP=0 CULL=0 LAYER=${layer} VIEWPORT=${viewport}")
        string(APPEND mesh_table "    {{${count}, 0, 0, ${layer} != 0, ${viewport} != 0, false}, mesh_${name}},\n")
    endforeach()
    edgecase_compile_shader(capture.geom geometry_${count} "${variants}")
    edgecase_compile_shader(capture.mesh mesh_${count} "${mesh_variants}")
    edgecase_compile_shader(capture.tesc control_${count} "control_${count} 1.1 ATTRIBUTES=${count}")
    edgecase_compile_shader(capture.tese evaluation_${count} "evaluation_${count} 1.1 ATTRIBUTES=${count}")
    edgecase_compile_shader(feedback.vert feedback_${count} "feedback_${count} 1.1 ATTRIBUTES=${count}")
    list(APPEND feedback_names feedback_${count})
    list(APPEND control_names control_${count})
    list(APPEND evaluation_names evaluation_${count})
endforeach()
list(JOIN feedback_names ", " feedback_names)
list(JOIN control_names ", " control_names)
list(JOIN evaluation_names ", " evaluation_names)

# Fragment shaders: attributes x the combinations of features below, one letter each:
# p probes, l lod, b barycentrics, m mask in, s sample, r shading rate, o mask out, k discard, z depth, c colour (float), u colour (uint),
# w two sources of colour (float), j several colours, n no instruments, t split instruments, d split with attributes in pairs (at most 8 colour attachments).
set(plain_features "-" o c u co uo cn un con uon k kc ku kcn kun z zc zu zn zcn zun kz kzc kzu kzcn kzun wn won kwn zwn kzwn
    j oj kj zj kzj jn ojn kjn zjn kzjn on kn kzn)
set(attribute_features p pl b m ms mo mso pb pm pms po bms bm r rm)
set(fragment_table "")
foreach(count RANGE 4)
    set(features ${plain_features})
    if(count GREATER 0)
        list(APPEND features ${attribute_features})
    endif()
    foreach(feature IN LISTS features)
        set(attachments 4)
        if(feature MATCHES "[cu]")
            set(attachments 5)
        elseif(feature MATCHES j)
            set(attachments 6)  # or more
        endif()
        math(EXPR whole "${attachments} + ${count}")
        math(EXPR paired "${whole} + ${count}")
        if(NOT feature MATCHES n AND NOT whole GREATER 8)
            list(APPEND features ${feature}t)
        endif()
        if(NOT feature MATCHES n AND count GREATER 0 AND NOT paired GREATER 8)
            list(APPEND features ${feature}td)
        endif()
    endforeach()
    set(variants "")
    foreach(feature IN LISTS features)
        set(defines "ATTRIBUTES=${count}")
        set(row "${count}")
        foreach(pair "p;PROBES" "l;LOD" "b;BARYCENTRICS" "m;MASK_IN" "s;SAMPLE" "r;RATE" "o;MASK_OUT" "k;DISCARD" "z;DEPTH" "t;SPLIT" "d;PAIRS")
            list(GET pair 0 letter)
            list(GET pair 1 define)
            if(feature MATCHES "${letter}")
                string(APPEND defines " ${define}=1")
                string(APPEND row ", true")
            else()
                string(APPEND defines " ${define}=0")
                string(APPEND row ", false")
            endif()
        endforeach()
        if(feature MATCHES c)
            string(APPEND defines " COLOR=1")
            string(APPEND row ", ColorKind::number")
        elseif(feature MATCHES u)
            string(APPEND defines " COLOR=2")
            string(APPEND row ", ColorKind::integer")
        elseif(feature MATCHES w)
            string(APPEND defines " COLOR=3")
            string(APPEND row ", ColorKind::two_numbers")
        elseif(feature MATCHES j)
            string(APPEND defines " COLOR=4")
            string(APPEND row ", ColorKind::several")
        else()
            string(APPEND defines " COLOR=0")
            string(APPEND row ", ColorKind::none")
        endif()
        if(feature MATCHES n)
            string(APPEND defines " INSTRUMENTS=0")
            string(APPEND row ", false")
        else()
            string(APPEND defines " INSTRUMENTS=1")
            string(APPEND row ", true")
        endif()
        string(REPLACE "-" "plain" word "${feature}")
        set(name fragment_${count}_${word})
        list(APPEND variants "${name} 1.1 ${defines}")
        string(APPEND fragment_table "    {{${row}}, ${name}},\n")
    endforeach()
    edgecase_compile_shader(capture.frag fragment_${count} "${variants}")
endforeach()
file(CONFIGURE OUTPUT ${EDGECASE_SHADER_DIR}/modules.inc CONTENT
"// The modules of all variants, made by cmake/Shaders.cmake; do not edit.
${EDGECASE_SHADER_INCLUDES}
constexpr Module<VertexVariant> kVertex[] = {
${vertex_table}};
constexpr Module<VertexVariant> kGeometry[] = {
${geometry_table}};
constexpr Module<VertexVariant> kMesh[] = {
${mesh_table}};
constexpr std::span<const uint32_t> kInput[] = {input_number, input_numbers, input_whole, input_wholes};
constexpr std::span<const uint32_t> kControl[] = {${control_names}};
constexpr std::span<const uint32_t> kEvaluation[] = {${evaluation_names}};
constexpr std::span<const uint32_t> kFeedback[] = {${feedback_names}};
constexpr std::span<const uint32_t> kClearVertex = over_target, kClearDepth = write_depth;
constexpr std::span<const uint32_t> kClear[] = {${clear_colors}};
constexpr std::span<const uint32_t> kBare[] = {bare_constant, bare_uniform, bare_offset, bare_storage, bare_texture, bare_texture, bare_texture, bare_mask};
constexpr std::span<const uint32_t> kMatrix[] = {vertex_matrix_0, vertex_matrix_1};
constexpr std::span<const uint32_t> kCopy[] = {copy_depth, copy_1, copy_2, copy_4, copy_unorm};
constexpr Module<FragmentVariant> kFragment[] = {
${fragment_table}};
")

add_library(edgecase_shaders STATIC ${CMAKE_SOURCE_DIR}/shaders/shaders.cpp
            ${CMAKE_SOURCE_DIR}/shaders/spirv_variant.cpp ${EDGECASE_SHADER_OUTPUTS})
target_include_directories(edgecase_shaders PUBLIC ${CMAKE_SOURCE_DIR} PRIVATE ${EDGECASE_SHADER_DIR})
target_link_libraries(edgecase_shaders PUBLIC edgecase::expected PRIVATE edgecase_warnings edgecase::fmt)
