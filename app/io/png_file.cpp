#include "app/io/png_file.h"

#include <png.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csetjmp>
#include <cstring>

#include "app/io/check_png.h"
#include "app/io/output_file.h"
#include "app/io/slice_shape.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

namespace {

/// One PNG file. libpng leaves a failed call by longjmp, so the functions that call it own nothing.
class PngDecoder {
public:
    explicit PngDecoder(const Source& source) : file_(source) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, &info_, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png_, this, onRead);
        if (!readHeader()) {
            png_destroy_read_struct(&png_, &info_, nullptr);
            fail();
        }
    }
    ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    const SliceShape& shape() const { return shape_; }
    std::size_t rowBytes() const {
        return std::size_t(shape_.width) * std::size_t(shape_.channels) * byteSize(shape_.type);
    }

    /// Fills `out` with all rows, in the machine's byte order.
    void read(std::byte* out) {
        std::vector<png_bytep> rows(std::size_t(shape_.height));
        for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = reinterpret_cast<png_bytep>(out + y * rowBytes());
        if (!readRows(rows.data())) fail();
    }

private:
    bool readHeader() {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);
        png_read_info(png_, info_);
        png_set_expand(png_);  // palettes to colours, 1 to 4 bits to 8, transparent colours to alpha
        png_set_swap(png_);    // the file is big-endian
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        shape_.width = int(png_get_image_width(png_, info_));
        shape_.height = int(png_get_image_height(png_, info_));
        shape_.channels = png_get_channels(png_, info_);
        shape_.type = png_get_bit_depth(png_, info_) == 16 ? VoxelType::UInt16 : VoxelType::UInt8;
        if (png_get_rowbytes(png_, info_) != rowBytes()) png_error(png_, "rows of an unexpected length");
        return true;
    }
    bool readRows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    [[noreturn]] void fail() const {
        throw Error(file_.name(), std::string("cannot be read as a picture (") + why_ + ")",
                    "the file may be damaged or cut off: save it anew");
    }

    static void onRead(png_structp png, png_bytep out, png_size_t length) {
        auto& self = *static_cast<PngDecoder*>(png_get_io_ptr(png));
        const std::size_t n = self.file_.readAt(self.at_, std::as_writable_bytes(std::span(out, length)));
        self.at_ += n;
        if (n != length) png_error(png, "it ends too early");
    }
    [[noreturn]] static void onError(png_structp png, png_const_charp why) {
        auto& self = *static_cast<PngDecoder*>(png_get_error_ptr(png));
        std::strncpy(self.why_, why, sizeof self.why_ - 1);
        png_longjmp(png, 1);
    }
    static void onWarning(png_structp, png_const_charp) {}

    InputFile file_;
    std::uint64_t at_ = 0;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    SliceShape shape_;
    char why_[120] = {};
};

/// Packs rows into a file.
class PngEncoder {
public:
    explicit PngEncoder(OutputFile& file) : file_(file) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, onError, nullptr);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) throw std::bad_alloc();
        png_set_write_fn(png_, this, onWrite, nullptr);
        png_set_compression_level(png_, 4);
    }
    ~PngEncoder() { png_destroy_write_struct(&png_, &info_); }
    PngEncoder(const PngEncoder&) = delete;
    PngEncoder& operator=(const PngEncoder&) = delete;

    bool write(Index2 size, int colorType, png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_IHDR(png_, info_, png_uint_32(size.x), png_uint_32(size.y), 8, colorType, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        png_write_info(png_, info_);
        png_write_image(png_, rows);
        png_write_end(png_, nullptr);
        return true;
    }
    std::exception_ptr failure() const { return failure_; }

private:
    static void onWrite(png_structp png, png_bytep bytes, png_size_t length) {
        auto& self = *static_cast<PngEncoder*>(png_get_io_ptr(png));
        bool failed = false;
        try {  // no exception may pass through C
            self.file_.write(std::as_bytes(std::span(bytes, length)));
        } catch (...) {
            self.failure_ = std::current_exception();
            failed = true;
        }
        if (failed) png_error(png, "write");
    }
    [[noreturn]] static void onError(png_structp png, png_const_charp) { png_longjmp(png, 1); }

    OutputFile& file_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::exception_ptr failure_;
};

/// Bytes of colours that are multiplied by alpha, divided by it.
std::vector<std::uint8_t> straightRgba8(const Picture& picture) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * 4);
    const auto byteOf = [](float value) { return std::uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f)); };
    for (const Vec4f& p : picture.pixels) {
        for (int c = 0; c < 3; ++c) bytes.push_back(byteOf(p.a > 0 ? p[c] / p.a : 0));
        bytes.push_back(byteOf(p.a));
    }
    return bytes;
}

}  // namespace

void readPngSlices(const SliceStack& stack, VolumeSink& sink) {
    const SliceShape first = PngDecoder(stack.files.front()).shape();
    const std::size_t count = stack.files.size();
    const auto voxels = sink.allocate(stack.name, headerOf(stack, first, count));
    const std::size_t bytes = voxels.size() / count;
    std::atomic<std::size_t> done{0};
    parallelFor(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            PngDecoder slice(stack.files[k]);
            checkAlike(stack.files[k].name, slice.shape(), first);
            slice.read(voxels.data() + k * bytes);
            sink.progress(double(++done) / double(count));
        }
    });
}

Picture readPng(const Source& source) {
    checkPng(source);
    PngDecoder decoder(source);
    const SliceShape& shape = decoder.shape();
    if (std::uint64_t(shape.width) * std::uint64_t(shape.height) > std::uint64_t(1) << 28)
        throw Error(source.name, "has more than 2^28 pixels", "reduce it");
    std::vector<std::byte> bytes(decoder.rowBytes() * std::size_t(shape.height));
    decoder.read(bytes.data());
    Picture picture(Index2(shape.width, shape.height));
    const std::size_t channels = std::size_t(shape.channels);
    const bool grey = channels < 3, alpha = channels % 2 == 0, wide = shape.type == VoxelType::UInt16;
    const auto value = [&](std::size_t i) {
        return wide ? float(reinterpret_cast<const std::uint16_t*>(bytes.data())[i]) / 65535
                    : float(std::to_integer<int>(bytes[i])) / 255;
    };
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const std::size_t at = i * channels;
        picture.pixels[i] = Vec4f(value(at), value(at + (grey ? 0 : 1)), value(at + (grey ? 0 : 2)),
                                  alpha ? value(at + channels - 1) : 1.0f);
    }
    return picture;
}

void writePng(const Picture& picture, const Source& target, bool transparent) {
    std::vector<std::uint8_t> bytes = transparent ? straightRgba8(picture) : toRgb8(picture);
    const std::size_t rowBytes = bytes.size() / std::size_t(picture.size.y);
    std::vector<png_bytep> rows(std::size_t(picture.size.y));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * rowBytes;
    OutputFile file(target);
    PngEncoder encoder(file);
    if (!encoder.write(picture.size, transparent ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, rows.data())) {
        if (encoder.failure()) std::rethrow_exception(encoder.failure());
        throw Error(target.name, "cannot be written as PNG", "choose a smaller picture");
    }
    file.close();
}

}  // namespace voledit
