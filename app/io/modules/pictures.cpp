#include "app/io/modules/pictures.h"

#include <OpenImageIO/imageio.h>

#include <atomic>
#include <cmath>
#include <map>

#include "app/io/slice_shape.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

namespace {

/// A file at one of its pages, values as stored.
class OpenPicture {
public:
    OpenPicture(const Source& source, int page) : source_(source) {
        OIIO::ImageSpec configuration;
        configuration.attribute("oiio:UnassociatedAlpha", 1);
        configuration.attribute("oiio:RawColor", 1);
        input_ = OIIO::ImageInput::open(source.path.string(), &configuration);
        if (!input_ || !input_->seek_subimage(page, 0)) fail(input_ ? input_->geterror() : OIIO::geterror());
        page_ = page;
    }

    const OIIO::ImageSpec& spec() const { return input_->spec(); }
    void turnTo(int page) {
        if (!input_->seek_subimage(page, 0)) fail(input_->geterror());
        page_ = page;
    }
    /// Fills `out` with all channels in `type`.
    void read(OIIO::TypeDesc type, void* out) {
        if (!input_->read_image(page_, 0, 0, spec().nchannels, type, out)) fail(input_->geterror());
    }

    [[noreturn]] void fail(const std::string& why) const {
        std::string line = why.substr(0, why.find('\n'));
        throw Error(source_.name, "cannot be read as a picture (" + (line.empty() ? "no reason given" : line) + ")",
                    "the file may be damaged or cut off: save it anew");
    }

private:
    const Source& source_;
    std::unique_ptr<OIIO::ImageInput> input_;
    int page_ = 0;
};

SliceShape shapeOf(const Source& source, const OIIO::ImageSpec& spec) {
    static const std::map<int, VoxelType> types{
        {OIIO::TypeDesc::UINT8, VoxelType::UInt8},   {OIIO::TypeDesc::INT8, VoxelType::Int8},
        {OIIO::TypeDesc::UINT16, VoxelType::UInt16}, {OIIO::TypeDesc::INT16, VoxelType::Int16},
        {OIIO::TypeDesc::UINT32, VoxelType::UInt32}, {OIIO::TypeDesc::INT32, VoxelType::Int32},
        {OIIO::TypeDesc::HALF, VoxelType::Float},    {OIIO::TypeDesc::FLOAT, VoxelType::Float},
        {OIIO::TypeDesc::DOUBLE, VoxelType::Double}};
    const auto type = types.find(spec.format.basetype);
    if (type == types.end() || spec.depth > 1 || spec.deep)
        throw Error(source.name, "has pixels of type " + std::string(spec.format.c_str()) + ", which are not read",
                    "save it with 8, 16 or 32-bit integers or floats");
    return {spec.width, spec.height, spec.nchannels, type->second};
}

OIIO::TypeDesc typeOf(VoxelType type) {
    switch (type) {
        case VoxelType::Int8:
            return OIIO::TypeDesc::INT8;
        case VoxelType::UInt8:
            return OIIO::TypeDesc::UINT8;
        case VoxelType::Int16:
            return OIIO::TypeDesc::INT16;
        case VoxelType::UInt16:
            return OIIO::TypeDesc::UINT16;
        case VoxelType::Int32:
            return OIIO::TypeDesc::INT32;
        case VoxelType::UInt32:
            return OIIO::TypeDesc::UINT32;
        case VoxelType::Float:
            return OIIO::TypeDesc::FLOAT;
        case VoxelType::Double:
            break;
    }
    return OIIO::TypeDesc::DOUBLE;
}

void readPages(const SliceStack& stack, VolumeSink& sink) {
    const Source& file = stack.files.front();
    OpenPicture picture(file, stack.pages.front());
    const SliceShape first = shapeOf(file, picture.spec());
    const auto voxels = sink.allocate(stack.name, headerOf(stack, first, stack.pages.size()));
    const std::size_t bytes = voxels.size() / stack.pages.size();
    for (std::size_t k = 0; k < stack.pages.size(); ++k) {
        picture.turnTo(stack.pages[k]);
        const SliceShape shape = shapeOf(file, picture.spec());
        checkAlike(file.name + ", page " + std::to_string(stack.pages[k] + 1), shape, first);
        picture.read(typeOf(first.type), voxels.data() + k * bytes);
        sink.progress(double(k + 1) / double(stack.pages.size()));
    }
}

void readFiles(const SliceStack& stack, VolumeSink& sink) {
    const OpenPicture picture(stack.files.front(), 0);
    const SliceShape first = shapeOf(stack.files.front(), picture.spec());
    const std::size_t count = stack.files.size();
    const auto voxels = sink.allocate(stack.name, headerOf(stack, first, count));
    const std::size_t bytes = voxels.size() / count;
    std::atomic<std::size_t> done{0};
    parallelFor(count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            OpenPicture slice(stack.files[k], 0);
            const SliceShape shape = shapeOf(stack.files[k], slice.spec());
            checkAlike(stack.files[k].name, shape, first);
            slice.read(typeOf(first.type), voxels.data() + k * bytes);
            sink.progress(double(++done) / double(count));
        }
    });
}

/// IEC 61966-2-1, odd beyond [0, 1] so that nothing is cut.
float linearFromSrgb(float value) {
    const float v = std::abs(value);
    const float linear = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    return std::copysign(linear, value);
}

void write(const Source& target, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels) {
    const auto fail = [&](const std::string& why) {
        throw Error(target.name, "cannot be written (" + why + ")", "check the disk's free space");
    };
    const auto output = OIIO::ImageOutput::create(target.path.string());
    if (!output) fail(OIIO::geterror());
    if (!output->open(target.path.string(), spec) || !output->write_image(type, pixels) || !output->close())
        fail(output->geterror());
}

}  // namespace

void voleditReadSlices(const SliceStack& stack, VolumeSink& sink) {
    OIIO::attribute("threads", 1);  // slices are read side by side
    if (stack.pages.empty())
        readFiles(stack, sink);
    else
        readPages(stack, sink);
}

void voleditReadPicture(const Source& source, Picture& picture) {
    OpenPicture input(source, 0);
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep || spec.nchannels < 1 || spec.nchannels > 64 ||
        std::uint64_t(spec.width) * std::uint64_t(spec.height) > std::uint64_t(1) << 28)
        throw Error(source.name, "is no flat picture of at most 2^28 pixels", "reduce or convert it");
    const std::size_t channels = std::size_t(spec.nchannels);
    picture = Picture(Index2(spec.width, spec.height));
    std::vector<float> values(picture.pixels.size() * channels);
    input.read(OIIO::TypeDesc::FLOAT, values.data());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const float* v = values.data() + i * channels;
        const bool grey = channels < 3;
        picture.pixels[i] = Vec4f(v[0], grey ? v[0] : v[1], grey ? v[0] : v[2], 1);
        if (channels == 2 || channels > 3) picture.pixels[i].w = v[channels == 2 ? 1 : 3];
    }
}

void voleditWriteExr(const Picture& picture, const Source& target, bool transparent) {
    Picture linear = picture;
    for (Vec4f& p : linear.pixels) {
        const float alpha = transparent && p.a > 0 ? p.a : 1;
        for (int c = 0; c < 3; ++c) p[c] = alpha * linearFromSrgb(p[c] / alpha);
    }
    OIIO::ImageSpec spec(picture.size.x, picture.size.y, 4, OIIO::TypeDesc::FLOAT);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("DateTime", "");  // else OpenImageIO writes the present: equal pictures shall be equal files
    write(target, spec, OIIO::TypeDesc::FLOAT, linear.pixels.data());
}

}  // namespace voledit
