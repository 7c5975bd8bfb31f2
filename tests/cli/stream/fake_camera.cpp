// SPDX-License-Identifier: BSD-3-Clause
// A Video4Linux camera for programs that load this first (LD_PRELOAD): FAKE_CAMERA is the name of its device,
// FAKE_CAMERA_TRIGGER a named pipe of which each byte releases a frame, FAKE_CAMERA_IMAGES a folder of
// 000000.jpg and so on, 320x240. It has MJPEG alone, takes 20 images a second by its own clock, and answers
// what a driver may leave out with EINVAL, as drivers do.
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

namespace {

constexpr unsigned kBufferBytes = 1U << 18;

struct FakeCamera {
  int file = -1;
  std::vector<void*> buffers;
  std::deque<unsigned> free;  // buffers that may be filled
  int taken = 0;
};

FakeCamera camera;

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int refuse(int reason) {
  errno = reason;
  return -1;
}

void describe(v4l2_pix_format& format) {
  format.width = 320;
  format.height = 240;
  format.pixelformat = V4L2_PIX_FMT_MJPEG;
  format.field = V4L2_FIELD_NONE;
  format.bytesperline = 0;
  format.sizeimage = kBufferBytes;
  format.colorspace = V4L2_COLORSPACE_JPEG;
}

void* buffer_at(std::size_t index) {
  while (camera.buffers.size() <= index)
    camera.buffers.push_back(real<decltype(&mmap)>("mmap")(nullptr, kBufferBytes, PROT_READ | PROT_WRITE,
                                                           MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  return camera.buffers[index];
}

int give_frame(v4l2_buffer& buffer) {
  char released = 0;
  if (camera.free.empty()) return refuse(EAGAIN);
  const ssize_t got = read(camera.file, &released, 1);
  if (got != 1) return refuse(got == 0 ? ENODEV : EAGAIN);
  char name[32];
  std::snprintf(name, sizeof name, "/%06d.jpg", camera.taken);
  std::FILE* const image = std::fopen((std::getenv("FAKE_CAMERA_IMAGES") + std::string(name)).c_str(), "rb");
  if (image == nullptr) return refuse(ENODEV);
  buffer.index = camera.free.front();
  camera.free.pop_front();
  buffer.bytesused = static_cast<unsigned>(std::fread(buffer_at(buffer.index), 1, kBufferBytes, image));
  std::fclose(image);
  buffer.length = kBufferBytes;
  buffer.flags = V4L2_BUF_FLAG_MAPPED | V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  buffer.timestamp = {1000 + camera.taken / 20, camera.taken % 20 * 50000};
  ++camera.taken;
  return 0;
}

int answer(unsigned long request, void* argument) {
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& capability = *static_cast<v4l2_capability*>(argument);
      std::memset(&capability, 0, sizeof capability);
      std::strcpy(reinterpret_cast<char*>(capability.driver), "fake");
      std::strcpy(reinterpret_cast<char*>(capability.card), "Fake camera");
      capability.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      return 0;
    }
    case VIDIOC_S_FMT:
    case VIDIOC_TRY_FMT:
    case VIDIOC_G_FMT:
      describe(static_cast<v4l2_format*>(argument)->fmt.pix);
      return 0;
    case VIDIOC_S_INPUT:
      return 0;
    case VIDIOC_G_INPUT:
      *static_cast<int*>(argument) = 0;
      return 0;
    case VIDIOC_G_PARM:
    case VIDIOC_S_PARM:
      static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, 20};
      return 0;
    case VIDIOC_REQBUFS:
      (void)buffer_at(static_cast<v4l2_requestbuffers*>(argument)->count);
      return 0;
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      buffer.length = kBufferBytes;
      buffer.m.offset = buffer.index * kBufferBytes;
      return 0;
    }
    case VIDIOC_QBUF:
      camera.free.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_DQBUF:
      return give_frame(*static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF:
      return 0;
    default:
      return refuse(EINVAL);
  }
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  const auto next = real<int (*)(const char*, int, ...)>("open");
  const char* const device = std::getenv("FAKE_CAMERA");
  if (device == nullptr || std::strcmp(path, device) != 0) return next(path, flags, mode);
  camera.free.clear();
  return camera.file = next(std::getenv("FAKE_CAMERA_TRIGGER"), O_RDONLY | O_NONBLOCK | O_CLOEXEC, 0);
}

int ioctl(int file, unsigned long request, ...) {
  std::va_list rest;
  va_start(rest, request);
  void* const argument = va_arg(rest, void*);
  va_end(rest);
  if (file < 0 || file != camera.file)
    return real<int (*)(int, unsigned long, ...)>("ioctl")(file, request, argument);
  return answer(static_cast<unsigned>(request), argument);
}

void* mmap(void* address, std::size_t length, int protection, int flags, int file, off_t offset) {
  if (file < 0 || file != camera.file)
    return real<decltype(&mmap)>("mmap")(address, length, protection, flags, file, offset);
  return buffer_at(static_cast<std::size_t>(offset) / kBufferBytes);
}

int munmap(void* address, std::size_t length) {
  for (void* const own : camera.buffers)
    if (address == own) return 0;  // used again
  return real<decltype(&munmap)>("munmap")(address, length);
}
}
