// Tests devices as a person writes them.
#include <gtest/gtest.h>

#include "app/gui/runner/WiringPanel.h"

namespace tacto::test {
namespace {

TEST(DevicesOf, AllowsBlanksInAFolder) {
    const auto uris = gui::devicesOf(" recording:/data/my finger sim:stimulator?gain=1.1  sim: ").value();
    ASSERT_EQ(uris.size(), 3U);
    EXPECT_EQ(uris[0].text(), "recording:/data/my finger");
    EXPECT_EQ(uris[1].text(), "sim:stimulator?gain=1.1");
    EXPECT_FALSE(gui::devicesOf("nonsense"));
}

}  // namespace
}  // namespace tacto::test
