// JPEG by libjpeg-turbo: stb's reader writes past its tables on hostile files (2.27, Huffman sizes that add
// up to more than 256).
#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <string>

// jpeglib.h wants stdio and size_t before it.
#include <jerror.h>
#include <jpeglib.h>

#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

constexpr int max_scans = 100;  // of a progressive file; encoders make about 10

struct Failure {
  jpeg_error_mgr manager;  // first, so that a pointer to it is a pointer to this
  jpeg_progress_mgr progress;
  std::jmp_buf jump;
  char text[JMSG_LENGTH_MAX];
};

[[noreturn]] void give_up(j_common_ptr decoder) {
  auto* failure = reinterpret_cast<Failure*>(decoder->err);
  decoder->err->format_message(decoder, failure->text);
  std::longjmp(failure->jump, 1);
}

void on_message(j_common_ptr decoder, int level) {
  // Most warnings are about bytes too many; a file that ends early is an error.
  if (level < 0 && decoder->err->msg_code == JWRN_JPEG_EOF) give_up(decoder);
}

void on_progress(j_common_ptr decoder) {
  if (reinterpret_cast<j_decompress_ptr>(decoder)->input_scan_number <= max_scans) return;
  auto* failure = reinterpret_cast<Failure*>(decoder->err);
  std::snprintf(failure->text, sizeof(failure->text), "more than %d scans", max_scans);
  std::longjmp(failure->jump, 1);
}

void prepare(jpeg_decompress_struct& decoder, Failure& failure, Bytes bytes) {
  decoder.err = jpeg_std_error(&failure.manager);
  failure.manager.error_exit = give_up;
  failure.manager.emit_message = on_message;
  jpeg_create_decompress(&decoder);
  failure.progress = {};
  failure.progress.progress_monitor = on_progress;
  decoder.progress = &failure.progress;
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
}

// The two below hold nothing with a destructor, because libjpeg leaves them by longjmp.

bool read_size(Failure& failure, Bytes bytes, uint32_t& width, uint32_t& height) {
  jpeg_decompress_struct decoder = {};
  if (setjmp(failure.jump)) {
    jpeg_destroy_decompress(&decoder);
    return false;
  }
  prepare(decoder, failure, bytes);
  jpeg_read_header(&decoder, TRUE);
  width = decoder.image_width;
  height = decoder.image_height;
  jpeg_destroy_decompress(&decoder);
  return true;
}

bool read_pixels(Failure& failure, Bytes bytes, uint8_t* rgba) {
  jpeg_decompress_struct decoder = {};
  if (setjmp(failure.jump)) {
    jpeg_destroy_decompress(&decoder);
    return false;
  }
  prepare(decoder, failure, bytes);
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_EXT_RGBA;
  decoder.dct_method = JDCT_ISLOW;  // integers: the same bits on every machine
  jpeg_start_decompress(&decoder);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row = rgba + size_t{decoder.output_scanline} * decoder.output_width * 4;
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
  jpeg_destroy_decompress(&decoder);
  return true;
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{0xff} && bytes[1] == std::byte{0xd8} &&
         bytes[2] == std::byte{0xff};
}

Texture decode_jpeg(const File& file, const std::string& where, Bytes bytes, size_t pixels_left) {
  Failure failure = {};
  Texture texture;
  if (!read_size(failure, bytes, texture.width, texture.height))
    file.fail(where, "not a JPEG that can be decoded: " + std::string(failure.text));
  check_image_size(file, where, texture.width, texture.height, bytes.size(), pixels_left);
  texture.rgba.resize(size_t{texture.width} * texture.height * 4);
  if (!read_pixels(failure, bytes, texture.rgba.data()))
    file.fail(where, "the JPEG cannot be decoded: " + std::string(failure.text));
  return texture;
}

}  // namespace ml::gltf
