#include "app/gui/window/Tour.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>
#include <limits>
#include <utility>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kLookInterval_ms = 60;
constexpr int kWidthChars = 46;
constexpr int kTallest = 10'000;        // px, of a text that has all the room
constexpr int kMargin = 24;             // from the window's edges
constexpr int kAboveStatus = 48;        // from its lower edge
constexpr double kControlCounts = 100;  // as much as so many of what else the text speaks of

}  // namespace

Tour::Tour(std::vector<TourStep> steps, QWidget* window) : QFrame(window), steps_(std::move(steps)) {
    setObjectName("tour");
    setAccessibleName(tr("Tour"));
    setFrameShape(QFrame::StyledPanel);
    setFrameShadow(QFrame::Raised);
    setAutoFillBackground(true);
    auto* layout = new QVBoxLayout(this);
    title_ = new QLabel(this);
    title_->setObjectName("tourTitle");
    setTextSize(*title_, TextSize::Large);
    layout->addWidget(title_);
    text_ = new QLabel(this);
    text_->setObjectName("tourText");
    text_->setWordWrap(true);
    layout->addWidget(text_);
    auto* row = new QHBoxLayout;
    place_ = new QLabel(this);
    place_->setObjectName("tourPlace");
    setTone(*place_, Tone::Quiet);
    row->addWidget(place_);
    row->addStretch();
    leave_ = new QPushButton(tr("Leave"), this);
    leave_->setToolTip(tr("Help > Tour continues from here."));
    back_ = new QPushButton(tr("Back"), this);
    next_ = new QPushButton(tr("Next"), this);
    next_->setToolTip(tr("Skips this step. The tour goes on by itself when the step is done."));
    for (auto* button : {leave_, back_, next_}) {
        button->setAutoDefault(false);
        row->addWidget(button);
    }
    layout->addLayout(row);
    connect(leave_, &QPushButton::clicked, this, [this] { end(false); });
    connect(back_, &QPushButton::clicked, this, [this] { go(step_ - 1, true); });
    connect(next_, &QPushButton::clicked, this, &Tour::goOn);
    look_.setInterval(kLookInterval_ms);
    connect(&look_, &QTimer::timeout, this, &Tour::look);
    window->installEventFilter(this);
    hide();
}

void Tour::begin(int step) {
    show();
    raise();
    look_.start();
    const bool known = step >= 0 && std::size_t(step) < steps_.size();
    go(known ? std::size_t(step) : 0, false);
    next_->setFocus();
}

void Tour::go(std::size_t step, bool back) {
    step_ = step;
    const auto& now = steps_[step_];
    done_.invalidate();
    shown_ = nullptr;
    title_->setText(now.title);
    back_->setEnabled(step_ > 0);
    next_->setText(step_ + 1 < steps_.size() ? tr("Next") : tr("Done"));
    if (now.enter) now.enter();
    waits_ = back && now.done && now.done();
    showPlace(waits_);
    emit stepped(int(step_));
    look();
}

void Tour::goOn() {
    if (step_ + 1 < steps_.size()) return go(step_ + 1, false);
    end(true);
}

void Tour::end(bool finished) {
    look_.stop();
    if (frame_) frame_->hide();
    hide();
    emit ended(finished);
}

void Tour::look() {
    const auto& now = steps_[step_];
    const auto target = now.target ? now.target() : TourTarget{};
    bringIntoView(target.widget);
    if (!frame_) frame_ = new TourFrame(window());  // it went with a dialog
    frame_->follow(target);
    if (const auto text = now.text(); !done_.isValid() && text_->text() != text) text_->setText(text);
    const bool isDone = now.done && now.done();
    if (!isDone && std::exchange(waits_, false)) showPlace(false);
    if (isDone && !waits_ && !done_.isValid()) {
        done_.start();
        showPlace(true);
    }
    place();
    if (done_.isValid() && done_.elapsed() >= now.linger_ms) goOn();
}

void Tour::showPlace(bool done) {
    place_->setText((done ? tr("%1 of %2 ✔ done") : tr("%1 of %2")).arg(step_ + 1).arg(steps_.size()));
}

/// Once, when it becomes the one that is talked about: what the user scrolls afterwards stays.
void Tour::bringIntoView(QWidget* control) {
    if (control == shown_ || control == nullptr || !control->isVisible()) return;
    shown_ = control;
    for (auto* above = control->parentWidget(); above != nullptr; above = above->parentWidget()) {
        if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(control, 0, 0);
    }
}

/// Where it hides least of the control, then of what else the text speaks of; the lower right corner first, and below
/// the safety bar: STOP is never covered.
void Tour::place() {
    // Never half of the window: a control beside it has room.
    const int wide =
        std::min(fontMetrics().averageCharWidth() * kWidthChars, parentWidget()->width() / 2 - 4 * kMargin);
    // Measured here: the label's own answer is that of the size of text before, when that has just changed.
    const auto lines = text_->fontMetrics().boundingRect(QRect(0, 0, wide, kTallest), Qt::TextWordWrap, text_->text());
    text_->setFixedSize(wide, lines.height() + 2);
    layout()->activate();
    const auto size = sizeHint();
    const auto room = parentWidget()->rect();
    int top = kMargin;
    if (const auto* bar = parentWidget()->findChild<QWidget*>("safetyBar"))
        top += bar->mapTo(parentWidget(), QPoint(0, bar->height())).y();
    const int right = room.width() - size.width() - kMargin;
    const int bottom = std::max(top, room.height() - size.height() - kAboveStatus);
    QRect control;
    if (frame_ && frame_->isVisible() && frame_->parentWidget() == parentWidget()) control = frame_->geometry();
    std::vector<QRect> others;
    if (const auto& about = steps_[step_].about) {
        for (auto* widget : about()) {
            if (widget != nullptr && widget->window() == window()) others.push_back(visiblePart({widget}));
        }
    }
    const auto areaOf = [](const QRect& part) { return part.isEmpty() ? 0.0 : double(part.width()) * part.height(); };
    QRect best;
    double least = std::numeric_limits<double>::max();
    const int centre = (room.width() - size.width()) / 2, middle = (top + bottom) / 2;
    // The usual places first, then those right beside the control.
    for (const int y : {bottom, top, middle, control.top() - size.height(), control.bottom() + 1}) {
        for (const int x : {right, kMargin, centre, control.left() - size.width(), control.right() + 1}) {
            if (x < 0 || x > right + kMargin || y < top - kMargin || y > bottom) continue;
            const QRect here(QPoint(x, y), size);
            double hides = kControlCounts * areaOf(here & control);
            for (const auto& other : others) hides += areaOf(here & other);
            if (hides >= least) continue;
            least = hides;
            best = here;
        }
    }
    if (geometry() != best) setGeometry(best);
    raise();
    if (frame_) frame_->raise();
}

bool Tour::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

}  // namespace tacto::gui

#include "moc_Tour.cpp"
