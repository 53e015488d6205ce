#include "core/safety/UnitFolders.h"

#include "core/base/DataFolder.h"

namespace tacto {

UnitFolders unitFolders() { return {dataFolder() / "units", "/run/lock"}; }

}  // namespace tacto
