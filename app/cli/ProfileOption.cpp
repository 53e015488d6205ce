#include "app/cli/ProfileOption.h"

#include "app/run/Shipped.h"

namespace tacto::cli {

Result<Profile> profileOption(const QCommandLineParser& parser) {
    return parser.isSet("profile") ? loadProfile(parser.value("profile").toStdString()) : shippedProfile();
}

}  // namespace tacto::cli
