#include "app/editor/places.h"

#include "app/editor/event_words.h"
#include "core/base/error.h"

namespace voledit {
namespace {

Place namedPlace(const std::string& function, const std::string& inner) {
    const std::vector<std::string> parts = partsOf(inner);
    const auto need = [&](std::size_t count, const char* form) {
        if (parts.size() != count || parts[0].empty())
            throw Error("@" + function + "(" + inner + "): expected " + form);
    };
    Place place;
    if (function == "view") {
        need(2, "@view(u,v), fractions of the viewport");
        place.kind = Place::Kind::View;
        place.at = {numberOf(parts[0], "@view"), numberOf(parts[1], "@view")};
    } else if (function == "point") {
        need(4, "@point(NAME,i,j,k), a lattice's control point");
        place.kind = Place::Kind::Point;
        for (int a = 0; a < 3; ++a) place.point[a] = wholeNumberOf(parts[std::size_t(a) + 1], "@point", 0);
    } else if (function == "joint") {
        need(1, "@joint(NAME)");
        place.kind = Place::Kind::Joint;
    } else if (function == "key") {
        need(2, "@key(TRACK,N)");
        place.kind = Place::Kind::Key;
        place.point.x = wholeNumberOf(parts[1], "@key", 0);
    } else if (function == "widget") {
        place.kind = Place::Kind::Widget;
        place.name = unquoted(trimmed(inner));  // commas belong to the label
        if (place.name.empty()) throw Error("@widget(): expected @widget(\"Panel/Label\")");
        return place;
    } else {
        throw Error("@" + function + " is no place: there are @view, @point, @joint, @key and @widget");
    }
    if (place.kind != Place::Kind::View) place.name = parts[0];
    return place;
}

}  // namespace

Place parsePlace(const std::string& text) {
    Place place;
    std::size_t plus = 0;
    if (text.starts_with('@')) {
        const auto open = text.find('(');
        const auto close = findUnquoted(text, ')');
        if (open == text.npos || close == text.npos || close < open)
            throw Error("\"" + text + "\": expected a place as @view(0.5,0.5)");
        place = namedPlace(text.substr(1, open - 1), text.substr(open + 1, close - open - 1));
        plus = close + 1;
        if (plus < text.size() && text[plus] != '+') throw Error("\"" + text + "\": expected +DX,DY after the place");
    } else if (text.starts_with('+')) {
        place.kind = Place::Kind::Here;
    } else {
        plus = text.find('+', 1);
        place.at = pairOf(text.substr(0, plus), "place");
    }
    if (plus < text.size()) place.offset = pairOf(text.substr(plus + 1), "offset");
    return place;
}

std::string textOf(const Place& place) {
    std::string text;
    switch (place.kind) {
        case Place::Kind::Pixel:
            text = pairText(place.at);
            break;
        case Place::Kind::View:
            text = "@view(" + pairText(place.at) + ")";
            break;
        case Place::Kind::Point:
            text = "@point(" + argumentText(place.name);
            for (int a = 0; a < 3; ++a) text += "," + std::to_string(place.point[a]);
            text += ")";
            break;
        case Place::Kind::Joint:
            text = "@joint(" + argumentText(place.name) + ")";
            break;
        case Place::Kind::Key:
            text = "@key(" + argumentText(place.name) + "," + std::to_string(place.point.x) + ")";
            break;
        case Place::Kind::Widget:
            text = "@widget(" + quoted(place.name) + ")";
            break;
        case Place::Kind::Here:
            return "+" + pairText(place.offset);
    }
    return place.offset == Vec2(0) ? text : text + "+" + pairText(place.offset);
}

}  // namespace voledit
