#include "app/gui/window/DisplaySight.h"

#include <QApplication>
#include <QGuiApplication>
#include <QWidget>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>
#include <xcb/xcb.h>
#include <xcb/xcbext.h>

namespace tacto::gui {

namespace {

template <class Reply>
using Owned = std::unique_ptr<Reply, decltype(&std::free)>;

template <class Reply>
Owned<Reply> owned(Reply* reply) {
    return {reply, &std::free};
}

constexpr std::uint32_t kEveryDesktop = 0xFFFF'FFFF;
constexpr int kAcross = 5, kDown = 3;  // number of points tested within a widget

bool isTaken(std::uint8_t status) {
    return status == XCB_GRAB_STATUS_ALREADY_GRABBED || status == XCB_GRAB_STATUS_FROZEN;
}

/// A point on the screen in pixels, and the window reached so far on the way down to the point.
struct Pressed {
    std::int16_t x, y;
    xcb_window_t in;
};

}  // namespace

struct DisplaySight::Server {
    explicit Server(xcb_connection_t* to) : connection(to) {}
    ~Server() { xcb_disconnect(connection); }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] xcb_atom_t atom(const char* name) const {
        const auto reply = owned(xcb_intern_atom_reply(
            connection, xcb_intern_atom(connection, 0, std::uint16_t(std::strlen(name)), name), nullptr));
        return reply ? reply->atom : xcb_atom_t{XCB_ATOM_NONE};
    }
    [[nodiscard]] std::optional<std::uint32_t> cardinal(xcb_window_t window, xcb_atom_t property) const {
        const auto reply = owned(xcb_get_property_reply(
            connection, xcb_get_property(connection, 0, window, property, XCB_ATOM_CARDINAL, 0, 1), nullptr));
        if (!reply || reply->format != 32 || xcb_get_property_value_length(reply.get()) < 4) return std::nullopt;
        std::uint32_t value = 0;
        std::memcpy(&value, xcb_get_property_value(reply.get()), sizeof value);
        return value;
    }
    /// Returns the deepest window under the pointer. A grab there does not move the pointer and causes no event.
    [[nodiscard]] xcb_window_t underPointer() const {
        auto window = root;
        for (;;) {
            const auto reply =
                owned(xcb_query_pointer_reply(connection, xcb_query_pointer(connection, window), nullptr));
            if (!reply || reply->child == XCB_WINDOW_NONE) return window;
            window = reply->child;
        }
    }

    /// Moves each point one step down, to the child of `in` that would get a press there (by the windows' shapes).
    void descend(std::vector<Pressed>& all) const {
        std::vector<xcb_translate_coordinates_cookie_t> asked;
        for (const auto& each : all)
            asked.push_back(xcb_translate_coordinates(connection, root, each.in, each.x, each.y));
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto reply = owned(xcb_translate_coordinates_reply(connection, asked[i], nullptr));
            all[i].in = reply ? reply->child : xcb_window_t{XCB_WINDOW_NONE};
        }
    }

    xcb_connection_t* connection;
    std::uint8_t saver = 0;  // opcode of MIT-SCREEN-SAVER; 0: not available
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
    constexpr std::string_view kSaver = "MIT-SCREEN-SAVER";
    const auto saver = owned(xcb_query_extension_reply(
        made->connection, xcb_query_extension(made->connection, std::uint16_t(kSaver.size()), kSaver.data()), nullptr));
    if (saver && saver->present != 0) made->saver = saver->major_opcode;
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

bool DisplaySight::isCovered(const QWidget& part) const {
    if (!own_ || part.window()->windowHandle() == nullptr || !part.isVisible()) return false;
    const auto window = static_cast<xcb_window_t>(part.window()->winId());
    const auto origin = owned(xcb_translate_coordinates_reply(
        own_->connection, xcb_translate_coordinates(own_->connection, window, own_->root, 0, 0), nullptr));
    if (!origin) return false;
    const double scale = part.devicePixelRatioF();
    std::vector<Pressed> open;
    for (int i = 0; i < kAcross * kDown; ++i) {
        const QPointF at((i % kAcross + 0.5) * part.width() / kAcross, (i / kAcross + 0.5) * part.height() / kDown);
        const auto in = part.mapTo(part.window(), at) * scale;
        if (QGuiApplication::screenAt(part.mapToGlobal(at).toPoint()) == nullptr) continue;
        open.push_back({std::int16_t(origin->dst_x + in.x()), std::int16_t(origin->dst_y + in.y()), own_->root});
    }
    // The window numbers of one client are equal in these bits, and differ from those of other clients.
    const auto ofClient = ~xcb_get_setup(own_->connection)->resource_id_mask;
    int arrive = 0;
    while (!open.empty()) {
        own_->descend(open);
        arrive += int(std::erase_if(open, [&](const auto& each) { return ((each.in ^ window) & ofClient) == 0; }));
        std::erase_if(open, [](const auto& each) { return each.in == XCB_WINDOW_NONE; });
    }
    return 2 * arrive < kAcross * kDown;
}

/// Sends the request directly: the library xcb-screensaver would be one more to install for a single request.
bool DisplaySight::isBlank() const {
    if (!own_ || own_->saver == 0) return false;
    struct {
        std::uint8_t major, minor;
        std::uint16_t words;
        std::uint32_t drawable;
    } request{own_->saver, 1, 2, own_->root};  // the request QueryInfo
    std::array<iovec, 3> parts{};
    parts[2] = {&request, sizeof request};  // xcb uses the two parts before this one
    const xcb_protocol_request_t info{1, nullptr, own_->saver, 0};
    const auto asked = xcb_send_request(own_->connection, XCB_REQUEST_CHECKED, &parts[2], &info);
    xcb_generic_error_t* error = nullptr;
    const auto reply = owned(static_cast<std::uint8_t*>(xcb_wait_for_reply(own_->connection, asked, &error)));
    std::free(error);
    return reply && reply.get()[1] == 1;  // the second byte is the state: off, on, disabled
}

bool DisplaySight::keysTakenByAnother() const {
    if (!own_) return false;
    auto* to = own_->connection;
    const auto key = xcb_grab_keyboard(to, 1, own_->root, XCB_CURRENT_TIME, XCB_GRAB_MODE_ASYNC, XCB_GRAB_MODE_SYNC);
    xcb_ungrab_keyboard(to, XCB_CURRENT_TIME);
    const auto keyboard = owned(xcb_grab_keyboard_reply(to, key, nullptr));
    return keyboard && isTaken(keyboard->status);
}

bool DisplaySight::grabbedByAnother() const {
    if (!own_ || QApplication::activePopupWidget() != nullptr || QWidget::mouseGrabber() != nullptr ||
        QGuiApplication::mouseButtons() != Qt::NoButton)
        return false;
    // Grabs are released before the answer is read, and events are frozen until then: the server keeps each press for
    // the window that it was meant for.
    auto* to = own_->connection;
    const auto press = xcb_grab_pointer(to, 1, own_->underPointer(), 0, XCB_GRAB_MODE_SYNC, XCB_GRAB_MODE_ASYNC,
                                        XCB_WINDOW_NONE, XCB_CURSOR_NONE, XCB_CURRENT_TIME);
    xcb_ungrab_pointer(to, XCB_CURRENT_TIME);
    const auto pointer = owned(xcb_grab_pointer_reply(to, press, nullptr));
    return pointer && isTaken(pointer->status) && keysTakenByAnother();
}

}  // namespace tacto::gui
