#include "app/gui/window/DisplaySight.h"

#include <QApplication>
#include <QGuiApplication>
#include <QWidget>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <xcb/xcb.h>

namespace tacto::gui {

namespace {

template <class Reply>
using Owned = std::unique_ptr<Reply, decltype(&std::free)>;

template <class Reply>
Owned<Reply> owned(Reply* reply) {
    return {reply, &std::free};
}

constexpr std::uint32_t kEveryDesktop = 0xFFFF'FFFF;

}  // namespace

struct DisplaySight::Server {
    explicit Server(xcb_connection_t* to) : connection(to) {}
    ~Server() { xcb_disconnect(connection); }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] xcb_atom_t atom(const char* name) const {
        const auto reply = owned(xcb_intern_atom_reply(
            connection, xcb_intern_atom(connection, 0, std::uint16_t(std::strlen(name)), name), nullptr));
        return reply ? reply->atom : XCB_ATOM_NONE;
    }
    [[nodiscard]] std::optional<std::uint32_t> cardinal(xcb_window_t window, xcb_atom_t property) const {
        const auto reply = owned(xcb_get_property_reply(
            connection, xcb_get_property(connection, 0, window, property, XCB_ATOM_CARDINAL, 0, 1), nullptr));
        if (!reply || reply->format != 32 || xcb_get_property_value_length(reply.get()) < 4) return std::nullopt;
        std::uint32_t value = 0;
        std::memcpy(&value, xcb_get_property_value(reply.get()), sizeof value);
        return value;
    }
    /// The deepest window under the pointer: a grab there moves the pointer into no other, and no window hears of it.
    [[nodiscard]] xcb_window_t underPointer() const {
        auto window = root;
        for (;;) {
            const auto reply =
                owned(xcb_query_pointer_reply(connection, xcb_query_pointer(connection, window), nullptr));
            if (!reply || reply->child == XCB_WINDOW_NONE) return window;
            window = reply->child;
        }
    }

    xcb_connection_t* connection;
    xcb_window_t root = XCB_WINDOW_NONE;
    xcb_atom_t windowsDesktop = XCB_ATOM_NONE, currentDesktop = XCB_ATOM_NONE;
};

DisplaySight::DisplaySight() {
    if (QGuiApplication::platformName() != "xcb") return;
    int screen = 0;
    auto made = std::make_unique<Server>(xcb_connect(nullptr, &screen));
    if (xcb_connection_has_error(made->connection) != 0) return;
    auto roots = xcb_setup_roots_iterator(xcb_get_setup(made->connection));
    for (; screen > 0 && roots.rem > 1; --screen) xcb_screen_next(&roots);
    made->root = roots.data->root;
    made->windowsDesktop = made->atom("_NET_WM_DESKTOP");
    made->currentDesktop = made->atom("_NET_CURRENT_DESKTOP");
    own_ = std::move(made);
}

DisplaySight::~DisplaySight() = default;

bool DisplaySight::onAnotherDesktop(const QWidget& window) const {
    if (!own_ || window.windowHandle() == nullptr) return false;
    const auto id = static_cast<xcb_window_t>(window.winId());
    const auto its = own_->cardinal(id, own_->windowsDesktop);
    const auto shown = own_->cardinal(own_->root, own_->currentDesktop);
    return its && shown && *its != kEveryDesktop && *its != *shown;
}

bool DisplaySight::grabbedByAnother() const {
    if (!own_ || QApplication::activePopupWidget() != nullptr || QWidget::mouseGrabber() != nullptr ||
        QGuiApplication::mouseButtons() != Qt::NoButton)
        return false;
    // Given back before the answer is read, and frozen until then: the server keeps what is pressed meanwhile for whom
    // it is meant.
    auto* to = own_->connection;
    const auto taken = [](std::uint8_t status) {
        return status == XCB_GRAB_STATUS_ALREADY_GRABBED || status == XCB_GRAB_STATUS_FROZEN;
    };
    const auto press = xcb_grab_pointer(to, 1, own_->underPointer(), 0, XCB_GRAB_MODE_SYNC, XCB_GRAB_MODE_ASYNC,
                                        XCB_WINDOW_NONE, XCB_CURSOR_NONE, XCB_CURRENT_TIME);
    xcb_ungrab_pointer(to, XCB_CURRENT_TIME);
    const auto pointer = owned(xcb_grab_pointer_reply(to, press, nullptr));
    if (!pointer || !taken(pointer->status)) return false;
    const auto key = xcb_grab_keyboard(to, 1, own_->root, XCB_CURRENT_TIME, XCB_GRAB_MODE_ASYNC, XCB_GRAB_MODE_SYNC);
    xcb_ungrab_keyboard(to, XCB_CURRENT_TIME);
    const auto keyboard = owned(xcb_grab_keyboard_reply(to, key, nullptr));
    return keyboard && taken(keyboard->status);
}

}  // namespace tacto::gui
