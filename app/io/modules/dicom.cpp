#include "app/io/modules/dicom.h"

#include <gdcmImageReader.h>
#include <gdcmScanner.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <sstream>

#include "app/io/check_dicom.h"
#include "app/io/checks.h"
#include "core/base/error.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

const gdcm::Tag kSeries(0x0020, 0x000e), kPosition(0x0020, 0x0032), kOrientation(0x0020, 0x0037),
    kInstance(0x0020, 0x0013), kAcquisition(0x0020, 0x0012), kTime(0x0020, 0x0100), kRows(0x0028, 0x0010),
    kColumns(0x0028, 0x0011), kPixelSpacing(0x0028, 0x0030), kImagerSpacing(0x0018, 0x1164),
    kSliceSpacing(0x0018, 0x0088), kThickness(0x0018, 0x0050), kIntercept(0x0028, 0x1052), kSlope(0x0028, 0x1053),
    kPixels(0x7fe0, 0x0010);

/// Numbers separated by backslashes.
std::vector<double> numbers(const char* text) {
    std::vector<double> values;
    std::istringstream in(text ? text : "");
    for (std::string word; std::getline(in, word, '\\');) {
        std::istringstream one(word);
        double value = 0;
        values.push_back(one >> value ? value : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
}

struct Rescale {
    double slope = 1, intercept = 0;

    bool operator==(const Rescale&) const = default;
};

struct Slice {
    Source file;
    std::string series;  // what files must share to be one volume
    Rescale rescale;
    std::optional<Vec3> position;
    std::array<double, 3> order{};  // acquisition, time, instance: which of several at one place is first
    double along = 0;               // position along the normal
};

class SeriesReader {
public:
    SeriesReader(const DicomFiles& files, VolumeSink& sink) : files_(files), sink_(sink) {}

    void read() {
        scan();
        chooseSeries();
        readGeometry();
        if (slices_.size() == 1 && frames() > 1) return readFrames();
        sortSlices();
        placeSlices();
        readSlices();
    }

private:
    struct Pixels {
        VoxelType type = VoxelType::UInt8;
        int channels = 1;
        Index3 size{1};

        bool operator==(const Pixels&) const = default;
    };

    void scan();
    void chooseSeries();
    void readGeometry();
    void sortSlices();
    void placeSlices();
    int frames();
    void readFrames();
    void readSlices();

    /// The picture of a file. Throws Error.
    const gdcm::Image& open(const Source& file, gdcm::ImageReader& reader) const;
    Pixels pixelsOf(const Source& file, const gdcm::Image& image) const;
    void decode(const Source& file, const gdcm::Image& image, std::span<std::byte> out) const;
    std::vector<double> tag(const gdcm::Tag& t) const { return numbers(scanner_->GetValue(key(), t)); }
    const char* key() const { return slices_.front().file.path.c_str(); }
    VolumeHeader header(const Pixels& pixels, int depth) const;

    const DicomFiles& files_;
    VolumeSink& sink_;
    gdcm::SmartPointer<gdcm::Scanner> scanner_;
    std::vector<Slice> slices_;
    Mat4 worldFromIndex_{1};
};

void SeriesReader::scan() {
    scanner_ = new gdcm::Scanner;
    for (const gdcm::Tag& t : {kSeries, kPosition, kOrientation, kInstance, kAcquisition, kTime, kRows, kColumns,
                               kPixelSpacing, kImagerSpacing, kSliceSpacing, kThickness, kIntercept, kSlope})
        scanner_->AddTag(t);
    gdcm::Directory::FilenamesType names;
    for (const Source& file : files_.files) names.push_back(file.path.string());
    scanner_->Scan(names);
    for (const Source& file : files_.files) {
        const char* name = file.path.c_str();
        // Reports, presentation states and the like have no pixels.
        if (!scanner_->IsKey(name) || !scanner_->GetValue(name, kRows)) continue;
        const auto text = [&](const gdcm::Tag& t) {
            const char* value = scanner_->GetValue(name, t);
            return std::string(value ? value : "");
        };
        Slice slice;
        slice.file = file;
        // A localizer shares its series with slices that lie another way.
        slice.series = text(kSeries) + "|" + text(kRows) + "x" + text(kColumns);
        for (const double cosine : numbers(scanner_->GetValue(name, kOrientation)))
            slice.series += "|" + std::to_string(std::lround(cosine * 100));
        if (const auto at = numbers(scanner_->GetValue(name, kPosition)); at.size() == 3)
            slice.position = Vec3(at[0], at[1], at[2]);
        const auto number = [&](const gdcm::Tag& t, double otherwise) {
            const auto values = numbers(scanner_->GetValue(name, t));
            return values.empty() || std::isnan(values[0]) ? otherwise : values[0];
        };
        slice.order = {number(kAcquisition, 0), number(kTime, 0), number(kInstance, 0)};
        slice.rescale = {number(kSlope, 1), number(kIntercept, 0)};
        if (slice.rescale.slope == 0) slice.rescale.slope = 1;
        slices_.push_back(std::move(slice));
    }
}

void SeriesReader::chooseSeries() {
    std::map<std::string, int> counts;
    std::string chosen;
    for (const Slice& slice : slices_) ++counts[slice.series];
    for (const auto& [series, count] : counts)
        if (chosen.empty() || count > counts[chosen]) chosen = series;
    if (files_.one) {
        const auto named = std::ranges::find(slices_, files_.one->path, [](const Slice& s) { return s.file.path; });
        if (named == slices_.end())
            throw Error(files_.name, "is DICOM without a picture, or damaged", "name a file of a picture series");
        chosen = named->series;
    }
    if (slices_.empty())
        throw Error(files_.name, "holds no DICOM picture that can be read", "name a folder with a picture series");
    std::erase_if(slices_, [&](const Slice& s) { return s.series != chosen; });
    if (!files_.one && counts.size() > 1)
        sink_.warn(files_.name + ": holds " + std::to_string(counts.size()) + " series; the largest, of " +
                   std::to_string(slices_.size()) + " slices, was read; name a file of another to read that");
}

/// The first two axes, from the orientation's row and column directions and the spacing between their pixels.
void SeriesReader::readGeometry() {
    const auto cosines = tag(kOrientation);
    Vec3 row(1, 0, 0), column(0, 1, 0);
    if (cosines.size() == 6) {
        row = Vec3(cosines[0], cosines[1], cosines[2]);
        column = Vec3(cosines[3], cosines[4], cosines[5]);
    }
    auto spacing = tag(kPixelSpacing);  // between rows, then between columns
    if (spacing.size() < 2) spacing = tag(kImagerSpacing);
    if (spacing.size() < 2) {
        spacing = {1, 1};
        if (frames() == 1) sink_.warn(files_.name + ": does not say its pixels' spacing; 1 mm was taken");
    }
    checkSpacing(files_.name + ", pixel spacing", Vec3(spacing[0], spacing[1], 1));
    worldFromIndex_[0] = Vec4(row * spacing[1], 0);
    worldFromIndex_[1] = Vec4(column * spacing[0], 0);
    const Vec3 normal = glm::cross(row, column);
    if (!(glm::length(normal) > 0.5))
        throw Error(files_.name, "its rows and columns do not span a plane", "the files are damaged: export them anew");
    worldFromIndex_[2] = Vec4(glm::normalize(normal), 0);
}

void SeriesReader::sortSlices() {
    const bool placed = std::ranges::all_of(slices_, [](const Slice& s) { return s.position.has_value(); });
    const Vec3 normal = Vec3(worldFromIndex_[2]);
    for (Slice& s : slices_) s.along = placed ? glm::dot(*s.position, normal) : s.order[2];
    for (const Slice& s : slices_)
        if (!std::isfinite(s.along)) throw Error(s.file.name, "has no usable position", "export the series anew");
    std::ranges::stable_sort(slices_, [](const Slice& a, const Slice& b) {
        return std::pair(a.along, a.order) < std::pair(b.along, b.order);
    });
    if (!placed) {
        sink_.warn(files_.name +
                   ": does not say where its slices lie; they were stacked in the order of their numbers");
        return;
    }
    // Several at one place are time steps, echoes or directions: the first is shown.
    const std::size_t all = slices_.size();
    const auto same = [](const Slice& a, const Slice& b) { return std::abs(a.along - b.along) < 1e-3; };
    slices_.erase(std::unique(slices_.begin(), slices_.end(), same), slices_.end());
    if (slices_.size() < all)
        sink_.warn(files_.name + ": has " + std::to_string(all) + " pictures at " + std::to_string(slices_.size()) +
                   " places; the first at each is shown");
}

/// The third axis, from the first to the last position; a gantry's tilt is thereby kept.
void SeriesReader::placeSlices() {
    if (slices_.front().position) worldFromIndex_[3] = Vec4(*slices_.front().position, 1);
    if (slices_.size() == 1 || !slices_.front().position) {
        auto step = tag(kSliceSpacing);
        if (step.empty() || !(step[0] > 0)) step = tag(kThickness);
        worldFromIndex_[2] *= step.empty() || !(step[0] > 0) ? 1.0 : step[0];
        return;
    }
    const double last = double(slices_.size() - 1);
    worldFromIndex_[2] = Vec4((*slices_.back().position - *slices_.front().position) / last, 0);
    const double mean = (slices_.back().along - slices_.front().along) / last;
    double least = mean, most = mean;
    for (std::size_t i = 1; i < slices_.size(); ++i) {
        least = std::min(least, slices_[i].along - slices_[i - 1].along);
        most = std::max(most, slices_[i].along - slices_[i - 1].along);
    }
    if (most - least > 0.02 * mean)
        sink_.warn(files_.name + ": its slices are " + std::to_string(least) + " to " + std::to_string(most) +
                   " mm apart (some may be missing); they were taken as evenly spaced");
}

const gdcm::Image& SeriesReader::open(const Source& file, gdcm::ImageReader& reader) const {
    reader.SetFileName(file.path.c_str());
    if (!reader.Read())
        throw Error(file.name, "its DICOM picture cannot be read", "the file is damaged or cut off: export it anew");
    const gdcm::DataSet& data = reader.GetFile().GetDataSet();
    if (data.FindDataElement(kPixels)) checkPixelData(file, data.GetDataElement(kPixels).GetVL());
    return reader.GetImage();
}

SeriesReader::Pixels SeriesReader::pixelsOf(const Source& file, const gdcm::Image& image) const {
    static const std::map<gdcm::PixelFormat::ScalarType, VoxelType> types{
        {gdcm::PixelFormat::UINT8, VoxelType::UInt8},   {gdcm::PixelFormat::INT8, VoxelType::Int8},
        {gdcm::PixelFormat::UINT16, VoxelType::UInt16}, {gdcm::PixelFormat::INT16, VoxelType::Int16},
        {gdcm::PixelFormat::UINT32, VoxelType::UInt32}, {gdcm::PixelFormat::INT32, VoxelType::Int32},
        {gdcm::PixelFormat::FLOAT32, VoxelType::Float}, {gdcm::PixelFormat::FLOAT64, VoxelType::Double}};
    const gdcm::PixelFormat& format = image.GetPixelFormat();
    const auto type = types.find(format.GetScalarType());
    if (type == types.end())
        throw Error(file.name, std::string("its pixels, ") + format.GetScalarTypeAsString() + ", are not read",
                    "export the series as 8, 16 or 32-bit pixels");
    const int channels = format.GetSamplesPerPixel();
    if (channels > 1 && image.GetPlanarConfiguration() != 0)
        throw Error(file.name, "stores its colours in planes, which is not read", "export the series as grey values");
    const int depth = image.GetNumberOfDimensions() > 2 ? int(image.GetDimension(2)) : 1;
    return {type->second, channels, Index3(int(image.GetDimension(0)), int(image.GetDimension(1)), depth)};
}

void SeriesReader::decode(const Source& file, const gdcm::Image& image, std::span<std::byte> out) const {
    if (image.GetBufferLength() != out.size() || !image.GetBuffer(reinterpret_cast<char*>(out.data())))
        throw Error(file.name, "its pixels cannot be decoded, or are not as many as its header claims",
                    "the file is damaged or cut off: export it anew");
}

VolumeHeader SeriesReader::header(const Pixels& pixels, int depth) const {
    VolumeHeader header;
    header.grid.size = Index3(pixels.size.x, pixels.size.y, depth);
    header.grid.channels = pixels.channels;
    header.grid.worldFromIndex = worldFromIndex_;
    header.type = pixels.type;
    header.format = "dicom";
    header.storedType = nameOf(pixels.type);
    checkAffine(files_.name, worldFromIndex_);
    checkSizes(files_.name, {std::uint64_t(pixels.size.x), std::uint64_t(pixels.size.y), std::uint64_t(depth)},
               std::uint64_t(pixels.channels));
    return header;
}

int SeriesReader::frames() {
    gdcm::ImageReader reader;
    return pixelsOf(slices_.front().file, open(slices_.front().file, reader)).size.z;
}

/// One file with all slices (enhanced CT and MR).
void SeriesReader::readFrames() {
    const Source& file = slices_.front().file;
    gdcm::ImageReader reader;
    const gdcm::Image& image = open(file, reader);
    const Pixels pixels = pixelsOf(file, image);
    const double* cosines = image.GetDirectionCosines();
    const Vec3 row(cosines[0], cosines[1], cosines[2]), column(cosines[3], cosines[4], cosines[5]);
    worldFromIndex_[0] = Vec4(row * image.GetSpacing(0), 0);
    worldFromIndex_[1] = Vec4(column * image.GetSpacing(1), 0);
    worldFromIndex_[2] = Vec4(glm::cross(row, column) * image.GetSpacing(2), 0);
    worldFromIndex_[3] = Vec4(image.GetOrigin(0), image.GetOrigin(1), image.GetOrigin(2), 1);
    const auto voxels = sink_.allocate(files_.name, header(pixels, pixels.size.z));
    decode(file, image, voxels);
    sink_.rescale(image.GetSlope(), image.GetIntercept());
}

/// out = in · slope + intercept.
void rescaleSlice(std::span<const std::byte> in, VoxelType type, const Rescale& rescale, std::span<std::byte> out) {
    auto* result = reinterpret_cast<float*>(out.data());
    withVoxelType(type, [&](auto t) {
        const auto* values = reinterpret_cast<const decltype(t)*>(in.data());
        for (std::size_t i = 0; i < in.size() / sizeof(t); ++i)
            result[i] = float(double(values[i]) * rescale.slope + rescale.intercept);
    });
}

/// Into the sink in the files' own type; as float where every slice has a slope of its own (PET).
void SeriesReader::readSlices() {
    const Rescale first = slices_.front().rescale;
    const bool uniform = std::ranges::all_of(slices_, [&](const Slice& s) { return s.rescale == first; });
    Pixels pixels;
    std::span<std::byte> voxels;
    std::vector<std::byte> stored;
    for (std::size_t k = 0; k < slices_.size(); ++k) {
        const Source& file = slices_[k].file;
        gdcm::ImageReader reader;
        const gdcm::Image& image = open(file, reader);
        if (k == 0) {
            pixels = pixelsOf(file, image);
            VolumeHeader all = header(pixels, int(slices_.size()));
            if (!uniform) {
                stored.resize(all.grid.valueCount() / slices_.size() * byteSize(pixels.type));
                all.type = VoxelType::Float;
            }
            voxels = sink_.allocate(files_.name, all);
        } else if (pixelsOf(file, image) != pixels) {
            throw Error(file.name, "differs in size or number type from the first slice, " + slices_[0].file.name,
                        "keep the files of one series together, apart from others");
        }
        const std::size_t bytes = voxels.size() / slices_.size();
        const auto slice = voxels.subspan(k * bytes, bytes);
        decode(file, image, uniform ? slice : std::span(stored));
        if (!uniform) rescaleSlice(stored, pixels.type, slices_[k].rescale, slice);
        sink_.progress(double(k + 1) / double(slices_.size()));
    }
    if (uniform) sink_.rescale(first.slope, first.intercept);
}

}  // namespace

void voleditReadDicom(const DicomFiles& files, VolumeSink& sink) {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    SeriesReader(files, sink).read();
}

}  // namespace voledit
