// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenGL without a window or a screen: EGL on the surfaceless platform, or, where that lacks, on
// the first device that EGL lists (NVIDIA's driver).
#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <set>
#include <stdexcept>
#include <string>

// Errors are one sentence, which main() prints.
[[noreturn]] inline void fail(const std::string& sentence) {
    throw std::runtime_error(sentence);
}

// An extension's function, which libOpenGL does not export.
template <class Function>
Function extension_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// The context, current on this thread as long as the program runs.
class Context {
  public:
    std::string renderer, version;
    bool is_45 = false;

    Context() {
        const auto get_display =
            extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
        const auto query_devices =
            extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
        EGLDisplay display = get_display == nullptr ? EGL_NO_DISPLAY
                                                    : get_display(EGL_PLATFORM_SURFACELESS_MESA,
                                                                  EGL_DEFAULT_DISPLAY, nullptr);
        bool is_ready =
            display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
        EGLDeviceEXT device = nullptr;
        EGLint devices = 0;
        if (!is_ready && get_display != nullptr && query_devices != nullptr &&
            query_devices(1, &device, &devices) == EGL_TRUE && devices == 1) {
            display = get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
            is_ready =
                display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
        }
        if (!is_ready) {
            fail(
                "EGL has neither a surfaceless platform nor a device: install libegl1, "
                "libegl-mesa0 and libgl1-mesa-dri, or the EGL of your driver");
        }
        eglBindAPI(EGL_OPENGL_API);
        // The newest version wins; 3.3 with extensions has most of what the cases need.
        EGLContext context = EGL_NO_CONTEXT;
        for (const EGLint minor : {6, 5, 3}) {
            const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     minor == 3 ? 3 : 4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     minor,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
            if (context == EGL_NO_CONTEXT) {
                context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
                is_45 = context != EGL_NO_CONTEXT && minor != 3;
            }
        }
        if (context == EGL_NO_CONTEXT ||
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
            fail("EGL makes no context of OpenGL 3.3 core or later without a surface");
        }
        renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
        for (GLint k = 0; k < number(GL_NUM_EXTENSIONS); ++k) {
            extensions_.insert(
                reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(k))));
        }
        for (const char* needed : {"GL_ARB_clip_control", "GL_ARB_viewport_array",
                                   "GL_ARB_draw_buffers_blend", "GL_ARB_texture_storage"}) {
            if (!has(needed)) {
                fail(renderer + " lacks " + needed + ", which every case needs here");
            }
        }
    }

    bool has(const std::string& extension) const { return extensions_.contains(extension); }

    static GLint number(GLenum name) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        return value;
    }

  private:
    std::set<std::string> extensions_;
};
