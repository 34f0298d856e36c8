#include "core/fields/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/parallel.h"

namespace voledit {
namespace {

template <class T>
VolumeStatistics statistics(const std::vector<T>& values, VoxelType type, int channels = 1) {
    return statisticsOf(type, std::as_bytes(std::span(values)), channels);
}

template <class T>
void expectDirectSums(VoxelType type, const std::vector<T>& values, int channels) {
    const VolumeStatistics found = statistics(values, type, channels);
    long double sum = 0;
    double min = kInfinity, max = -kInfinity;
    std::size_t count = 0;
    const auto each = [&](const auto& body) {
        for (std::size_t i = 0; i < values.size(); i += std::size_t(channels))
            if (std::isfinite(double(values[i]))) body(double(values[i]));
    };
    each([&](double v) {
        sum += v;
        min = std::min(min, v);
        max = std::max(max, v);
        ++count;
    });
    EXPECT_EQ(found.min, min);
    EXPECT_EQ(found.max, max);
    EXPECT_NEAR(found.mean, double(sum / count), 1e-12 * (max - min));
    std::vector<std::uint64_t> histogram(256);
    each([&](double v) { ++histogram[std::min<std::size_t>(255, std::size_t((v - min) / (max - min) * 256))]; });
    EXPECT_EQ(found.histogram, histogram);
}

TEST(Statistics, AreTheDirectSumsForEveryType) {
    std::mt19937 random(1);
    const auto integers = [&](auto t, VoxelType type) {
        using T = decltype(t);
        std::vector<T> values(600001 * 2);
        for (T& v : values) v = T(std::normal_distribution<double>(20, 15)(random));
        expectDirectSums(type, values, 1);
        expectDirectSums(type, values, 2);
    };
    integers(std::int8_t{}, VoxelType::Int8);
    integers(std::uint8_t{}, VoxelType::UInt8);
    integers(std::int16_t{}, VoxelType::Int16);
    integers(std::uint16_t{}, VoxelType::UInt16);
    integers(std::int32_t{}, VoxelType::Int32);
    integers(std::uint32_t{}, VoxelType::UInt32);
    integers(float{}, VoxelType::Float);
    integers(double{}, VoxelType::Double);
}

TEST(Statistics, LeaveOutWhatIsNotFinite) {
    const auto found = statistics(std::vector<float>{1, NAN, 3, INFINITY, -INFINITY}, VoxelType::Float);
    EXPECT_EQ(found.min, 1);
    EXPECT_EQ(found.max, 3);
    EXPECT_EQ(found.mean, 2);
    EXPECT_EQ(found.histogram.front() + found.histogram.back(), 2u);
}

TEST(Statistics, OfNothingFiniteAreZero) {
    const auto found = statistics(std::vector<double>{NAN, NAN}, VoxelType::Double);
    EXPECT_EQ(found.min, 0);
    EXPECT_EQ(found.max, 0);
    EXPECT_EQ(found.mean, 0);
    EXPECT_EQ(found.histogram, std::vector<std::uint64_t>(256));
}

TEST(Statistics, OfOneValueFillTheLastBin) {
    for (const auto& found : {statistics(std::vector<std::int16_t>(10, -7), VoxelType::Int16),
                              statistics(std::vector<float>(10, -7), VoxelType::Float)}) {
        EXPECT_EQ(found.min, -7);
        EXPECT_EQ(found.max, -7);
        EXPECT_EQ(found.mean, -7);
        EXPECT_EQ(found.histogram[255], 10u);
    }
}

TEST(Statistics, AreTheSameForEveryNumberOfThreads) {
    std::mt19937 random(2);
    std::vector<float> values(1500000);
    for (float& v : values) v = std::normal_distribution<float>(0, 1)(random);
    setThreadCount(1);
    const auto one = statistics(values, VoxelType::Float);
    setThreadCount(0);
    const auto all = statistics(values, VoxelType::Float);
    EXPECT_EQ(one.mean, all.mean);
    EXPECT_EQ(one.histogram, all.histogram);
}

template <class T>
void expectTheExtremes(std::size_t count, VoxelType type, int channels = 1) {
    std::mt19937 random(count);
    std::vector<T> values(count * std::size_t(channels));
    for (T& v : values) v = T(random());
    const auto bytes = std::as_bytes(std::span(values));
    const VolumeStatistics all = statisticsOf(type, bytes, channels), extremes = extremesOf(type, bytes, channels);
    EXPECT_EQ(extremes.min, all.min) << count;
    EXPECT_EQ(extremes.max, all.max) << count;
}

TEST(Extremes, AreThoseOfTheStatistics) {
    for (const std::size_t count : {1, 5, 1000, 1024, 1025, 300000, 1 << 18}) {
        expectTheExtremes<std::uint8_t>(count, VoxelType::UInt8);
        expectTheExtremes<std::int16_t>(count, VoxelType::Int16);
        expectTheExtremes<std::uint32_t>(count, VoxelType::UInt32);
        expectTheExtremes<double>(count, VoxelType::Double);
    }
    expectTheExtremes<std::int16_t>(1000, VoxelType::Int16, 3);
}

TEST(Extremes, AreOfFiniteValues) {
    for (const auto& values : {std::vector<float>{1, NAN, 3, INFINITY, -INFINITY}, std::vector<float>{NAN, NAN},
                               std::vector<float>{NAN, 7}, std::vector<float>{INFINITY}}) {
        const auto bytes = std::as_bytes(std::span(values));
        EXPECT_EQ(extremesOf(VoxelType::Float, bytes, 1).min, statisticsOf(VoxelType::Float, bytes, 1).min);
        EXPECT_EQ(extremesOf(VoxelType::Float, bytes, 1).max, statisticsOf(VoxelType::Float, bytes, 1).max);
    }
}

TEST(Extremes, AreCompletedWhenAsked) {
    const auto values = std::make_shared<std::vector<std::uint8_t>>(std::vector<std::uint8_t>{3, 9, 4, 4});
    const auto bytes = std::as_bytes(std::span(*values));
    const Volume volume({{4, 1, 1}, 1, Mat4(1.0)}, VoxelType::UInt8, bytes, values,
                        extremesOf(VoxelType::UInt8, bytes, 1));
    EXPECT_TRUE(volume.statistics().histogram.empty());
    EXPECT_EQ(volume.statistics().max, 9);
    const VolumeStatistics counted = countedStatistics(volume);
    EXPECT_EQ(counted.mean, 5);
    EXPECT_EQ(counted.histogram, statisticsOf(VoxelType::UInt8, bytes, 1).histogram);
}

}  // namespace
}  // namespace voledit
