#include "core/io/unique_names.h"

#include <cstdint>

namespace voledit {

std::string UniqueNames::unique(const std::string& name) {
    const auto [place, fresh] = last_.try_emplace(name, 1);
    if (fresh) return name;
    for (;;) {
        const std::string numbered = name + "_" + std::to_string(++place->second);
        if (last_.try_emplace(numbered, 1).second) return numbered;
    }
}

bool isUtf8(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? std::uint8_t(text[i]) : std::uint8_t(0); };
    for (std::size_t i = 0; i < text.size();) {
        const std::uint8_t lead = byte(i++);
        if (lead < 0x80) continue;
        if (lead < 0xc2 || lead > 0xf4) return false;
        const int more = lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
        const std::uint8_t lowest = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
        const std::uint8_t highest = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
        if (byte(i) < lowest || byte(i) > highest) return false;
        ++i;
        for (int n = 1; n < more; ++n, ++i)
            if ((byte(i) & 0xc0) != 0x80) return false;
    }
    return true;
}

std::string utf8OfLatin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto byte = std::uint8_t(c);
        if (byte < 0x80) {
            utf8 += c;
        } else {
            utf8 += char(0xc0 | byte >> 6);
            utf8 += char(0x80 | (byte & 0x3f));
        }
    }
    return utf8;
}

}  // namespace voledit
