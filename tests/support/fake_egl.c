/* An EGL whose list of devices is whatever a test says, in front of the one that is installed.
 *
 * FAKE_EGL_REAL     path of the installed libEGL.so.1, whose software device draws for all
 * FAKE_EGL_DEVICES  the list, for example "file=/dev/dri/renderD128,cuda=1,fails=0x3001;software":
 *                   a device has a render node, CUDA's number, fails to initialize with this error
 * FAKE_EGL_HIDES    extensions, separated by spaces, that displays and EGL itself do not have
 */
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void (*Function)(void);
typedef struct {
  char extensions[256], file[64];
  int cuda, fails;
} Device;

enum { kMost = 8, kExtensions = 0x3055, kRenderNode = 0x3377, kCuda = 0x323A };
static Device devices[kMost];
static int count = -1;
static int pending_error; /* for eglGetError, instead of the real one's */

static Function real(const char* name) {
  static void* library;
  if (!library) library = dlopen(getenv("FAKE_EGL_REAL"), RTLD_NOW | RTLD_LOCAL);
  return library ? (Function)dlsym(library, name) : NULL;
}
#define REAL(result, name, types) ((result(*) types)real(#name))

static Function real_extension(const char* name) {
  return REAL(Function, eglGetProcAddress, (const char*))(name);
}

static void read_list(void) {
  if (count >= 0) return;
  count = 0;
  char* text = strdup(getenv("FAKE_EGL_DEVICES") ? getenv("FAKE_EGL_DEVICES") : "");
  char *outer, *inner;
  for (char* d = strtok_r(text, ";", &outer); d; d = strtok_r(NULL, ";", &outer)) {
    Device* device = &devices[count++];
    device->cuda = -1;
    for (char* word = strtok_r(d, ",", &inner); word; word = strtok_r(NULL, ",", &inner)) {
      if (!strcmp(word, "software")) strcat(device->extensions, "EGL_MESA_device_software ");
      if (!strncmp(word, "file=", 5)) {
        strcat(device->extensions, "EGL_EXT_device_drm_render_node ");
        snprintf(device->file, sizeof device->file, "%s", word + 5);
      }
      if (!strncmp(word, "cuda=", 5)) {
        strcat(device->extensions, "EGL_NV_device_cuda ");
        device->cuda = atoi(word + 5);
      }
      if (!strncmp(word, "fails=", 6)) device->fails = (int)strtol(word + 6, NULL, 16);
    }
  }
}

static unsigned query_devices(int size, void** handles, int* found) {
  read_list();
  if (!handles) {
    *found = count;
    return 1;
  }
  *found = size < count ? size : count;
  for (int k = 0; k < *found; ++k) handles[k] = &devices[k];
  return 1;
}

static const char* query_string(void* device, int name) {
  if (name == kExtensions) return ((Device*)device)->extensions;
  return name == kRenderNode && *((Device*)device)->file ? ((Device*)device)->file : NULL;
}

static unsigned query_attribute(void* device, int name, intptr_t* value) {
  *value = ((Device*)device)->cuda;
  return name == kCuda && *value >= 0;
}

/* The display of a device that fails is the device; the others share the installed software's. */
static void* platform_display(unsigned platform, void* native, const int* attributes) {
  if (native && ((Device*)native)->fails) return native;
  if (native) {
    void* all[kMost];
    int found = 0;
    ((unsigned (*)(int, void**, int*))real_extension("eglQueryDevicesEXT"))(kMost, all, &found);
    native = all[found - 1];
  }
  return ((void* (*)(unsigned, void*, const int*))real_extension("eglGetPlatformDisplayEXT"))(
      platform, native, attributes);
}

unsigned eglInitialize(void* display, int* major, int* minor) {
  for (int k = 0; k < count; ++k) {
    if (display == &devices[k]) {
      pending_error = devices[k].fails;
      return 0;
    }
  }
  return REAL(unsigned, eglInitialize, (void*, int*, int*))(display, major, minor);
}

int eglGetError(void) {
  const int error = pending_error;
  pending_error = 0;
  return error ? error : REAL(int, eglGetError, (void))();
}

/* A new copy each time, with the hidden names overwritten. */
const char* eglQueryString(void* display, int name) {
  const char* text = REAL(const char*, eglQueryString, (void*, int))(display, name);
  const char* hides = getenv("FAKE_EGL_HIDES");
  if (!text || !hides || name != kExtensions) return text;
  char *shown = strdup(text), *names = strdup(hides), *rest;
  for (char* hidden = strtok_r(names, " ", &rest); hidden; hidden = strtok_r(NULL, " ", &rest)) {
    char* at = strstr(shown, hidden);
    if (at) memset(at, 'x', strlen(hidden));
  }
  return shown;
}

Function eglGetProcAddress(const char* name) {
  if (!strcmp(name, "eglQueryDevicesEXT")) return (Function)query_devices;
  if (!strcmp(name, "eglQueryDeviceStringEXT")) return (Function)query_string;
  if (!strcmp(name, "eglQueryDeviceAttribEXT")) return (Function)query_attribute;
  if (!strcmp(name, "eglGetPlatformDisplayEXT")) return (Function)platform_display;
  return real_extension(name);
}

/* The rest as it is. */
unsigned eglBindAPI(unsigned api) { return REAL(unsigned, eglBindAPI, (unsigned))(api); }
unsigned eglQueryAPI(void) { return REAL(unsigned, eglQueryAPI, (void))(); }
unsigned eglChooseConfig(void* display, const int* wanted, void** configs, int size, int* found) {
  return REAL(unsigned, eglChooseConfig, (void*, const int*, void**, int, int*))(
      display, wanted, configs, size, found);
}
void* eglCreateContext(void* display, void* config, void* share, const int* attributes) {
  return REAL(void*, eglCreateContext, (void*, void*, void*, const int*))(display, config, share,
                                                                         attributes);
}
void* eglCreatePbufferSurface(void* display, void* config, const int* attributes) {
  return REAL(void*, eglCreatePbufferSurface, (void*, void*, const int*))(display, config,
                                                                         attributes);
}
unsigned eglDestroyContext(void* display, void* context) {
  return REAL(unsigned, eglDestroyContext, (void*, void*))(display, context);
}
unsigned eglDestroySurface(void* display, void* surface) {
  return REAL(unsigned, eglDestroySurface, (void*, void*))(display, surface);
}
void* eglGetCurrentContext(void) { return REAL(void*, eglGetCurrentContext, (void))(); }
void* eglGetCurrentDisplay(void) { return REAL(void*, eglGetCurrentDisplay, (void))(); }
void* eglGetCurrentSurface(int which) { return REAL(void*, eglGetCurrentSurface, (int))(which); }
unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
  return REAL(unsigned, eglMakeCurrent, (void*, void*, void*, void*))(display, draw, read, context);
}
