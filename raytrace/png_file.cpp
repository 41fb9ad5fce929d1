#include "raytrace/png_file.h"

#include <png.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <new>
#include <vector>

#include "base/error.h"
#include "base/large_room.h"

namespace barkridge {

namespace {

// IEC 61966-2-1.
double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::uint8_t to_byte(double unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0, 1.0))); }

std::vector<std::uint8_t> straight_srgb(const Image& image) {
  std::vector<std::uint8_t> bytes;
  resize_large(bytes, image.rgba.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bytes.size() / 4), [&](const auto& pixels) {
    for (std::size_t i = 4 * pixels.begin(); i < 4 * pixels.end(); i += 4) {
      const double alpha = image.rgba[i + 3];
      for (std::size_t c = 0; c < 3; ++c) {
        const double straight = alpha > 0 ? image.rgba[i + c] / alpha : 0.0;
        bytes[i + c] = to_byte(srgb_encoded(std::clamp(straight, 0.0, 1.0)));
      }
      bytes[i + 3] = to_byte(alpha);
    }
  });
  return bytes;
}

// The plain kind of text chunk is Latin-1 and the international one UTF-8. What is ASCII is both, and more programs
// read the plain kind. The result points into `metadata`.
std::vector<png_text> text_chunks(const ImageMetadata& metadata) {
  std::vector<png_text> chunks;
  for (const auto& [name, text] : metadata) {
    const bool ascii =
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
    png_text chunk{};
    chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(name.c_str());
    chunk.text = const_cast<char*>(text.c_str());
    chunks.push_back(chunk);
  }
  return chunks;
}

using Reason = std::array<char, 256>;

// libpng's errors jump to where `write_chunks` set out.
[[noreturn]] void fail(png_structp png, png_const_charp reason) {
  Reason& kept = *static_cast<Reason*>(png_get_error_ptr(png));
  std::snprintf(kept.data(), kept.size(), "%s", reason);
  png_longjmp(png, 1);
}

// libpng would print them.
void drop_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, std::size_t size) {
  OutputFile& file = *static_cast<OutputFile*>(png_get_io_ptr(png));
  file.write(data, size);
  if (file.failed()) png_error(png, "the file failed");
}

// Left out, libpng would take the file for one of the C library's.
void no_flush(png_structp) {}

struct Writer {
  explicit Writer(OutputFile& file) : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &reason, fail, drop_warning)) {
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png, &file, append, no_flush);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  Reason reason{};
  png_structp png;
  png_infop info = nullptr;
};

// Whether it came to the end. The jump skips destructors, so that nothing in here may have one.
bool write_chunks(const Writer& writer, const PixelRegion& region, const std::uint8_t* rgba,
                  const std::vector<png_text>& texts) {
  const png_structp png = writer.png;
  const png_infop info = writer.info;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const auto width = static_cast<png_uint_32>(region.width), height = static_cast<png_uint_32>(region.height);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  if (region.x != 0 || region.y != 0) png_set_oFFs(png, info, region.x, region.y, PNG_OFFSET_PIXEL);
  png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  // Grain hides the likeness of neighbours, so that rows as they are make smaller files of most pictures than
  // differences do, and the level takes a quarter of the default's time.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 4);
  png_write_info(png, info);
  for (std::size_t row = 0; row < height; ++row) png_write_row(png, rgba + row * 4 * width);
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

void encode_png(const Image& image, const std::string& path, const ImageMetadata& metadata, OutputFile& file) {
  const std::vector<std::uint8_t> rgba = straight_srgb(image);
  const std::vector<png_text> texts = text_chunks(metadata);
  const Writer writer(file);
  const bool done = write_chunks(writer, image.region, rgba.data(), texts);
  if (!done && !file.failed()) throw IoError(path, writer.reason.data());
}

}  // namespace barkridge
