// voledit-io: parses files for voledit in a process of its own, so that a hostile one cannot harm the editor.

#include <cstdio>
#include <cstdlib>

#include "app/io/limits.h"
#include "app/io/session.h"

int main(int argc, char** argv) {
    const int parent = argc == 2 ? std::atoi(argv[1]) : 0;
    if (parent <= 0) {
        std::fputs("voledit-io: started by voledit, not by hand\n", stderr);
        return 2;
    }
    voledit::confineProcess(parent);
    voledit::serve(3);
    return 0;
}
