#pragma once
// Random scenes of everything that a file can hold, for the tests of what must work for all of it.

#include <memory>

#include "core/scene/scene.h"

namespace voledit::test {

/// Every scene can be written and read; names of every kind are used; with `tracks`, anything may have some; without
/// `fitted`, every limb has a size, so that compiling fits none.
class RandomScenes {
public:
    explicit RandomScenes(unsigned seed, bool tracks = true, bool fitted = true);
    ~RandomScenes();

    Scene next();

private:
    class Maker;
    std::unique_ptr<Maker> maker_;
};

}  // namespace voledit::test
