#include "app/gui/theme/KeyState.h"

#include <QGuiApplication>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <xcb/xcb.h>

namespace tacto::gui {

std::optional<bool> isKeyDown(quint32 scanCode) {
    // The offscreen platform offers this interface too, but has no server.
    const auto* x11 = qGuiApp->nativeInterface<QNativeInterface::QX11Application>();
    auto* server = x11 != nullptr && QGuiApplication::platformName() == "xcb" ? x11->connection() : nullptr;
    if (server == nullptr) return {};
    const std::unique_ptr<xcb_query_keymap_reply_t, decltype(&std::free)> keys(
        xcb_query_keymap_reply(server, xcb_query_keymap(server), nullptr), &std::free);
    constexpr quint32 kBits = 8;
    return keys != nullptr && scanCode / kBits < std::size(keys->keys) &&
           (keys->keys[scanCode / kBits] >> (scanCode % kBits) & 1) != 0;
}

}  // namespace tacto::gui
