#include "tests/house/Layers.h"

#include <fstream>

namespace tacto::test {

Targets readTargets(std::istream& in) {
    Targets targets;
    Target* current = nullptr;
    for (std::string key, value; in >> key && std::getline(in >> std::ws, value);) {
        if (key == "target") current = &targets[value];
        if (key == "source") current->sources.push_back(value);
        if (key == "links") current->links.push_back(value);
        if (key == "hands_on") current->handsOn.push_back(value);
    }
    return targets;
}

Targets targetsOfTheBuild() {
    std::ifstream in(TACTO_LAYERS);
    return readTargets(in);
}

}  // namespace tacto::test
