#include "app/gui/theme/LookChange.h"

#include <QEvent>
#include <utility>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

class LookChange final : public QObject {
public:
    LookChange(QWidget& widget, bool withPalette, std::function<void()> follow)
        : QObject(&widget), withPalette_(withPalette), follow_(std::move(follow)) {
        widget.installEventFilter(this);
    }
    bool eventFilter(QObject*, QEvent* event) override {
        const auto type = event->type();
        if (type == QEvent::FontChange || (withPalette_ && type == QEvent::PaletteChange)) follow_();
        return false;
    }

private:
    const bool withPalette_;
    const std::function<void()> follow_;
};

class AfterLookChange final : public QObject {
public:
    AfterLookChange(QWidget& widget, std::function<void()> follow) : QObject(&widget), follow_(std::move(follow)) {
        widget.installEventFilter(this);
    }
    bool eventFilter(QObject*, QEvent* event) override {
        const auto type = event->type();
        const bool changed = type == QEvent::FontChange || type == QEvent::PaletteChange || type == QEvent::StyleChange;
        if (!changed || std::exchange(queued_, true)) return false;
        const auto turn = [this] {
            queued_ = false;
            follow_();
        };
        QMetaObject::invokeMethod(this, turn, Qt::QueuedConnection);
        return false;
    }

private:
    const std::function<void()> follow_;
    bool queued_ = false;
};

}  // namespace

void onLookChange(QWidget& widget, std::function<void()> follow) { new LookChange(widget, true, std::move(follow)); }
void onFontChange(QWidget& widget, std::function<void()> follow) { new LookChange(widget, false, std::move(follow)); }

void afterLookChange(QWidget& widget, std::function<void()> follow) { new AfterLookChange(widget, std::move(follow)); }

void boundWidth(QWidget& widget, int atMost_px) {
    const auto bound = [&widget, atMost_px] { widget.setMaximumWidth(scaledPx(atMost_px)); };
    bound();
    onFontChange(widget, bound);
}

void fixWidth(QWidget& widget, int px) {
    const auto fix = [&widget, px] { widget.setFixedWidth(scaledPx(px)); };
    fix();
    onFontChange(widget, fix);
}

}  // namespace tacto::gui
