#include "app/gui/pilot/HeldKey.h"

#include <QGuiApplication>
#include <cstdlib>
#include <memory>
#include <xcb/xcb.h>

namespace tacto::gui {

bool isStillDown(const QKeyEvent& released) {
    // The offscreen platform has the interface too, and no server behind it.
    const auto* x11 = qGuiApp->nativeInterface<QNativeInterface::QX11Application>();
    auto* server = x11 != nullptr && QGuiApplication::platformName() == "xcb" ? x11->connection() : nullptr;
    if (server == nullptr) return false;
    const std::unique_ptr<xcb_query_keymap_reply_t, decltype(&std::free)> keys(
        xcb_query_keymap_reply(server, xcb_query_keymap(server), nullptr), &std::free);
    const auto code = released.nativeScanCode();
    constexpr quint32 kBits = 8;
    return keys != nullptr && code / kBits < std::size(keys->keys) &&
           (keys->keys[code / kBits] >> (code % kBits) & 1) != 0;
}

}  // namespace tacto::gui
