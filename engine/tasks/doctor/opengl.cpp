#include "engine/tasks/doctor/opengl.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

// The few words of EGL that are needed (EGL 1.5, EGL_EXT_platform_base, EGL_MESA_platform_surfaceless).
using Display = void*;
using Config = void*;
using Context = void*;
using GetProcAddress = void* (*)(const char*);
using GetDisplay = Display (*)(void*);
using GetPlatformDisplay = Display (*)(unsigned, void*, const std::int32_t*);
using Initialize = unsigned (*)(Display, std::int32_t*, std::int32_t*);
using BindApi = unsigned (*)(unsigned);
using ChooseConfig = unsigned (*)(Display, const std::int32_t*, Config*, std::int32_t, std::int32_t*);
using CreateContext = Context (*)(Display, Config, Context, const std::int32_t*);
using MakeCurrent = unsigned (*)(Display, void*, void*, Context);
using GetString = const char* (*)(unsigned);
constexpr unsigned kSurfaceless = 0x31DD;
constexpr unsigned kOpenGlApi = 0x30A2;
constexpr std::int32_t kNone = 0x3038;
constexpr std::int32_t kConfig[] = {0x3033, 0, 0x3040, 0x0008, kNone};  // any surface; OpenGL
constexpr std::int32_t kVersion33[] = {0x3098, 3, 0x30FB, 3, 0x30FD, 0x00000001, kNone};  // core profile
constexpr unsigned kRenderer = 0x1F01;
constexpr unsigned kVersion = 0x1F02;

constexpr const char* kInstall =
    "apt-get install libegl1 libgl1 libgl1-mesa-dri, or the graphics card's driver";

template <class Function>
Function symbol(void* library, const char* name) {
  return reinterpret_cast<Function>(::dlsym(library, name));
}

// "ok 4.5 (Core Profile) Mesa 22.3.6 on llvmpipe", or "no <why>".
std::string context_on(void* egl, Display display) {
  const auto initialize = symbol<Initialize>(egl, "eglInitialize");
  const auto bind = symbol<BindApi>(egl, "eglBindAPI");
  const auto choose = symbol<ChooseConfig>(egl, "eglChooseConfig");
  const auto create = symbol<CreateContext>(egl, "eglCreateContext");
  const auto make_current = symbol<MakeCurrent>(egl, "eglMakeCurrent");
  const auto address = symbol<GetProcAddress>(egl, "eglGetProcAddress");
  if (!initialize || !bind || !choose || !create || !make_current || !address)
    return "no: libEGL is not whole";
  if (display == nullptr || initialize(display, nullptr, nullptr) == 0) return "no: no display can be opened";
  if (bind(kOpenGlApi) == 0) return "no: the driver has OpenGL ES only";
  Config config = nullptr;
  std::int32_t count = 0;
  if (choose(display, kConfig, &config, 1, &count) == 0 || count < 1)
    return "no: the driver offers no OpenGL";
  const Context context = create(display, config, nullptr, kVersion33);
  if (context == nullptr) return "no: the driver has no OpenGL 3.3 core profile";
  if (make_current(display, nullptr, nullptr, context) == 0)
    return "no: the driver cannot draw without a window";
  const auto get_string = reinterpret_cast<GetString>(address("glGetString"));
  const char* version = get_string != nullptr ? get_string(kVersion) : nullptr;
  const char* renderer = get_string != nullptr ? get_string(kRenderer) : nullptr;
  if (version == nullptr || renderer == nullptr) return "no: the driver does not say what it is";
  return fmt::format("ok OpenGL {}, {}", version, renderer);
}

std::string context_in_words() {
  void* egl = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (egl == nullptr) return "no: libEGL.so.1 is not installed";
  const auto address = symbol<GetProcAddress>(egl, "eglGetProcAddress");
  const auto get_display = symbol<GetDisplay>(egl, "eglGetDisplay");
  if (address == nullptr || get_display == nullptr) return "no: libEGL is not whole";
  std::string answer = "no: no display";
  if (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr)
    answer = context_on(egl, get_display(nullptr));
  if (answer.starts_with("ok")) return answer + ", with a display";
  const auto platform_display = reinterpret_cast<GetPlatformDisplay>(address("eglGetPlatformDisplayEXT"));
  if (platform_display == nullptr) return answer;
  answer = context_on(egl, platform_display(kSurfaceless, nullptr, nullptr));
  return answer.starts_with("ok") ? answer + ", without a display" : answer;
}

// In a process of its own: drivers crash and hang, and leave threads behind.
std::string answer_of_a_child() {
  int ends[2];
  if (::pipe(ends) != 0) throw io_error("make", "a pipe", errno);
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::string answer = context_in_words();
    const ssize_t written = ::write(ends[1], answer.data(), answer.size());
    ::_exit(written == static_cast<ssize_t>(answer.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string answer;
  char bytes[1024];
  pollfd wanted{ends[0], POLLIN, 0};
  constexpr int kPatienceMilliseconds = 20'000;
  const bool spoke = child > 0 && ::poll(&wanted, 1, kPatienceMilliseconds) == 1;
  const ssize_t got = spoke ? ::read(ends[0], bytes, sizeof bytes) : 0;
  if (got > 0) answer.assign(bytes, static_cast<std::size_t>(got));
  ::close(ends[0]);
  if (child > 0) {
    ::kill(child, SIGKILL);
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  if (!answer.empty()) return answer;
  return spoke ? "no: the driver crashed" : "no: the driver did not answer within 20 s";
}

}  // namespace

Finding check_opengl() {
  const std::string answer = answer_of_a_child();
  if (!answer.starts_with("ok ")) {
    return warning(fmt::format("there is none ({}); the command line does without it, the editor needs it",
                               answer.substr(answer.find(' ') + 1)),
                   kInstall);
  }
  const std::string what = answer.substr(3);
  const bool software =
      what.find("llvmpipe") != std::string::npos || what.find("softpipe") != std::string::npos;
  return ok(software ? what + "; drawn by the processor: good enough, not quick" : what);
}

}  // namespace footwall::tasks
