// The library of formula files, and reading one from disk.

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/base/paths.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestFile = std::size_t(1) << 20;

std::string readText(const fs::path& file) {
    const std::string remedy = "check the name and that it may be read";
    std::error_code problem;
    if (!fs::is_regular_file(file, problem)) throw Error(file.string(), "there is no such formula file", remedy);
    std::ifstream in(file, std::ios::binary);
    std::string text(kLargestFile + 1, '\0');
    in.read(text.data(), std::streamsize(text.size()));
    if (in.bad() || !in.is_open()) throw Error(file.string(), "this formula file cannot be read", remedy);
    text.resize(std::size_t(in.gcount()));
    if (text.size() > kLargestFile)
        throw Error(file.string(), "this formula file is larger than 1 MiB",
                    "is it a formula file? Write a shorter one");
    return text;
}

std::vector<TransferDefinitionPtr> readLibrary() {
    std::vector<fs::path> files;
    const fs::path folder = resourceFolder() / "transfers";
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder, problem))
        if (entry.path().extension() == ".stf") files.push_back(entry.path());
    if (problem)
        throw Error(folder.string(), "the formula files cannot be listed: " + problem.message(),
                    "repair the installation, or set VOLEDIT_RESOURCES to its resources");
    std::sort(files.begin(), files.end());
    std::vector<TransferDefinitionPtr> library;
    for (const fs::path& file : files) library.push_back(TransferDefinition::load(file));
    return library;
}

}  // namespace

TransferDefinitionPtr TransferDefinition::load(const fs::path& file) {
    return parse(readText(file), file.stem().string(), file.string());
}

const std::vector<TransferDefinitionPtr>& transferLibrary() {
    static const std::vector<TransferDefinitionPtr> library = readLibrary();
    return library;
}

TransferDefinitionPtr libraryTransfer(const std::string& name) {
    for (const TransferDefinitionPtr& definition : transferLibrary())
        if (definition->name() == name) return definition;
    return nullptr;
}

}  // namespace voledit
