#include "app/gui/scope/screen/ScopeGestures.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

namespace tacto::gui {

namespace {

constexpr double kStillAClick = 3;  ///< pixels; a shorter movement is a click
constexpr double kSnap = 8;         ///< pixels within which a cursor snaps
constexpr double kPick = 8;         ///< pixels from a trace within which a click picks it

Qt::CursorShape shapeFor(Grip grip, bool held) {
    switch (grip) {
        case Grip::Lane:
        case Grip::LevelCursor:
            return Qt::SizeVerCursor;
        case Grip::TriggerLevel:
            return held ? Qt::ForbiddenCursor : Qt::SizeVerCursor;
        case Grip::TriggerMoment:
        case Grip::TimeCursor:
            return Qt::SizeHorCursor;
        case Grip::None:
            break;
    }
    return Qt::ArrowCursor;
}

}  // namespace

ScopeGestures::ScopeGestures(ScopeModel& model, ScopeScreen& screen) : model_(model), screen_(screen) {
    screen_.installEventFilter(this);
    connect(&screen_, &QCustomPlot::mouseWheel, this, [this](const QWheelEvent* event) { turn(*event); });
}

bool ScopeGestures::eventFilter(QObject* watched, QEvent* event) {
    if (watched != &screen_) return false;
    switch (event->type()) {
        case QEvent::MouseButtonPress:
            press(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseMove:
            move(static_cast<QMouseEvent*>(event)->position());
            return true;
        case QEvent::MouseButtonRelease:
            release(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseButtonDblClick:
            if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) return true;
            drag_ = Drag::None;
            model_.fit();
            return true;
        case QEvent::KeyPress:
            return keyPressed(*static_cast<QKeyEvent*>(event));
        case QEvent::Leave:
            model_.hover({});
            return false;
        default:
            return false;
    }
}

QString ScopeGestures::gripLane() const {
    const auto& lanes = screen_.overlay().lanes;
    const auto at = static_cast<std::size_t>(grip_.which);
    return grip_.grip == Grip::Lane && at < lanes.size() ? lanes[at].key : QString();
}

void ScopeGestures::press(const QMouseEvent& event) {
    screen_.setFocus(Qt::MouseFocusReason);
    if (event.button() != Qt::LeftButton) return;
    pressedAt_ = event.position();
    pressedView_ = model_.viewport();
    model_.hover({});
    grip_ = screen_.gripAt(pressedAt_);
    drag_ = Drag::Undecided;
    if (boxZoom_ || event.modifiers().testFlag(Qt::ShiftModifier)) {
        drag_ = Drag::Box;
    } else if (grip_.grip != Grip::None) {
        drag_ = Drag::Grip;
        model_.setActiveLane(gripLane());
        if (grip_.grip == Grip::TimeCursor) model_.focusCursor(grip_.which);
        if (grip_.grip == Grip::LevelCursor) model_.focusCursor(2 + grip_.which);
    }
}

void ScopeGestures::move(const QPointF& at) {
    const auto way = at - pressedAt_;
    switch (drag_) {
        case Drag::None:
            return hover(at);
        case Drag::Undecided:
            if (way.manhattanLength() <= kStillAClick) return;
            drag_ = Drag::Pan;
            model_.remember();
            screen_.setCursor(Qt::ClosedHandCursor);
            [[fallthrough]];
        case Drag::Pan:
            return model_.dragView(pressedView_, -way.x() * screen_.secondsPerPixel(),
                                   -way.y() * screen_.divisionsPerPixel());
        case Drag::Box:
            return screen_.setBox(QRectF(pressedAt_, at).normalized());
        case Drag::Grip:
            return dragGrip(at);
    }
}

void ScopeGestures::release(const QMouseEvent& event) {
    if (event.button() != Qt::LeftButton) return;
    const auto at = event.position();
    const auto was = std::exchange(drag_, Drag::None);
    if (was == Drag::Box) endBox();
    if (was == Drag::Undecided) {
        model_.pickLane(screen_.timeAt(at.x() - 3), screen_.timeAt(at.x() + 3), screen_.heightAt(at.y()),
                        kPick * screen_.divisionsPerPixel());
    }
    model_.dropTrigger();
    grip_ = {};
    hover(at);
}

void ScopeGestures::endBox() {
    const auto box = screen_.overlay().box.value_or(QRectF()).intersected(QRectF(screen_.area()));
    screen_.setBox({});
    if (boxZoom_) {
        boxZoom_ = false;
        emit boxZoomEnded();
    }
    if (box.width() < 2 * kStillAClick || box.height() < 2 * kStillAClick) return;
    model_.zoomToBox(screen_.timeAt(box.left()), screen_.timeAt(box.right()), screen_.heightAt(box.bottom()),
                     screen_.heightAt(box.top()));
}

void ScopeGestures::setBoxZoom(bool on) {
    boxZoom_ = on;
    screen_.setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
}

void ScopeGestures::dragGrip(const QPointF& pixel) {
    const double height = screen_.heightAt(pixel.y()), time_s = screen_.timeAt(pixel.x());
    switch (grip_.grip) {
        case Grip::Lane:
            return model_.dragLane(pressedView_, gripLane(), height);
        case Grip::TriggerLevel:
            return model_.dragTriggerLevel(height, grip_.which == 1);
        case Grip::TriggerMoment:
            return model_.dragTriggerMoment(time_s);
        case Grip::TimeCursor:
            return model_.dragTimeCursor(grip_.which, time_s, kSnap * screen_.secondsPerPixel());
        case Grip::LevelCursor:
            return model_.dragLevelCursor(grip_.which, height, kSnap * screen_.divisionsPerPixel());
        case Grip::None:
            return;
    }
}

void ScopeGestures::turn(const QWheelEvent& event) {
    const auto turned = event.angleDelta().y() != 0 ? event.angleDelta().y() : event.angleDelta().x();
    if (turned == 0 || !model_.shown()) return;
    const int steps = turned > 0 ? -1 : 1;  // turning the wheel forward zooms in
    if (event.modifiers().testFlag(Qt::ControlModifier)) {
        model_.zoomLevel(steps, screen_.heightAt(event.position().y()), "level wheel");
    } else if (event.modifiers().testFlag(Qt::ShiftModifier)) {
        model_.pan(steps * model_.viewport().perDivision_s / 2, 0, "pan wheel");
    } else {
        model_.zoomTime(steps, screen_.timeAt(event.position().x()), "time wheel");
    }
}

void ScopeGestures::hover(const QPointF& pixel) {
    const auto grip = screen_.gripAt(pixel).grip;
    screen_.setCursor(boxZoom_ ? Qt::CrossCursor : shapeFor(grip, model_.trigger().held()));
    const bool between = grip == Grip::None && screen_.area().contains(pixel.toPoint());
    model_.hover(between ? std::optional(screen_.timeAt(pixel.x())) : std::nullopt);
}

bool ScopeGestures::keyPressed(const QKeyEvent& event) {
    const auto modifiers = event.modifiers();
    const bool control = modifiers.testFlag(Qt::ControlModifier);
    if (event.matches(QKeySequence::Undo)) {
        model_.undoZoom();
        return true;
    }
    switch (event.key()) {
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
            nudge(event.key(), modifiers);
            return true;
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            zoomByKey(-1, control);
            return true;
        case Qt::Key_Minus:
            zoomByKey(1, control);
            return true;
        case Qt::Key_Home:
            model_.fit();
            return true;
        case Qt::Key_1:
        case Qt::Key_2:
        case Qt::Key_3:
        case Qt::Key_4:
            if (control) return false;
            model_.focusCursor(event.key() - Qt::Key_1);
            return true;
        default:
            return false;
    }
}

void ScopeGestures::zoomByKey(int steps, bool level) {
    if (level) {
        const auto* active = model_.lane(model_.activeLane());
        if (active != nullptr) model_.zoomLevel(steps, model_.scaleOf(*active).position, "level keys");
        return;
    }
    const auto& cursors = model_.cursors();
    const double anchor = cursors.timeFocused() ? (*cursors.time_s())[static_cast<std::size_t>(cursors.focused())]
                                                : model_.restingTime_s();
    model_.zoomTime(steps, anchor, "time keys");
}

void ScopeGestures::nudge(int key, Qt::KeyboardModifiers modifiers) {
    const bool across = key == Qt::Key_Left || key == Qt::Key_Right;
    const double sign = key == Qt::Key_Right || key == Qt::Key_Up ? 1 : -1;
    const double pixels = sign * (modifiers.testFlag(Qt::ShiftModifier) ? 10 : 1);
    const bool jump = modifiers.testFlag(Qt::ControlModifier);
    if (across) {
        if (jump ? model_.jumpTimeCursor(sign) : model_.nudgeTimeCursor(pixels * screen_.secondsPerPixel())) return;
        model_.pan(sign * model_.viewport().perDivision_s / 5, 0, "pan keys");
    } else {
        if (model_.nudgeLevelCursor(pixels * screen_.divisionsPerPixel())) return;
        model_.pan(0, -sign / 5, "pan keys");
    }
}

}  // namespace tacto::gui

#include "moc_ScopeGestures.cpp"
