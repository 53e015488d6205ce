// Writes to the file named first what `tactoscope-cli firmware-profile` writes for a board with the default profile.
#include <fstream>

#include "tests/firmware/ProfileOnQemu.h"

int main(int, char** arguments) {
    std::ofstream(arguments[1]) << tacto::profileHeader(tacto::test::profileOnQemu(), "default");
    return 0;
}
