// SPDX-License-Identifier: BSD-3-Clause
#include "map_file/map_file_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "map_file/file_advice.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kWorthWriting = 64 * 1024;  // bytes

}  // namespace

MapFileOutput::MapFileOutput(const std::string& path) : path_(path), part_(path + ".part") {
  struct stat status = {};
  // A device must not be replaced, which root could do.
  if (::stat(path.c_str(), &status) == 0) {
    const std::string kind = otherKindOfFile(status.st_mode);
    if (!kind.empty()) throw MapFileError(path + ": this is " + kind + "; name a file for the map");
  }
  // What an earlier run left there, or a link: never what the link leads to.
  if (::unlink(part_.c_str()) != 0 && errno != ENOENT) fail(errno);
  file_ = std::fopen(part_.c_str(), "wxe");
  if (file_ == nullptr) fail(errno);
}

MapFileOutput::~MapFileOutput() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  ::unlink(part_.c_str());
}

void MapFileOutput::header(std::uint32_t sections) {
  buffer_.raw(kMapMagic, kMapMagicSize);
  buffer_.u32(kMapSchema);
  buffer_.u32(sections);
  flush();
}

void MapFileOutput::begin(const SectionTag& tag, std::uint64_t size) {
  crc_ = {};
  buffer_.raw(tag.data(), tag.size());
  buffer_.u64(size);
}

void MapFileOutput::pass() {
  if (buffer_.size() >= kWorthWriting) flush();
}

void MapFileOutput::end() {
  flush();
  buffer_.u32(crc_.value());
  flush();
}

void MapFileOutput::flush() {
  crc_.add(buffer_.data(), buffer_.size());
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size()) fail(errno);
  buffer_.clear();
}

void MapFileOutput::commit() {
  // The drone may be switched off next.
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail(errno);
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::unlink(part_.c_str());
    fail(error);
  }
  syncFolder();
}

void MapFileOutput::syncFolder() {
  const std::size_t slash = path_.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path_.substr(0, slash + 1);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A folder that may be written to but not listed, or a file system that cannot do it: the new
  // name comes onto the disk when the system likes to.
  if (descriptor < 0) return;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0 && error != EINVAL && error != ENOTSUP)
    throw MapFileError(path_ + ": the map is written, but it may be gone if the power fails: " +
                       std::strerror(error) + "; " + fileAdvice(error));
}

void MapFileOutput::fail(int error) {
  throw MapFileError(path_ + ": the map cannot be written: " + std::strerror(error) + "; " +
                     fileAdvice(error));
}

}  // namespace ardrone_vslam
