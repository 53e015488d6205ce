#include "app/gui/window/Tour.h"

#include <QEvent>
#include <QPainter>
#include <QScrollArea>
#include <QStyle>
#include <limits>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kLookInterval_ms = 150;
constexpr int kWidthChars = 46;
constexpr int kMargin = 24;       // distance from the window's edges
constexpr int kAboveStatus = 48;  // distance from the window's lower edge

}  // namespace

Tour::Tour(std::vector<TourStep> steps, QWidget* window) : QFrame(window), steps_(std::move(steps)) {
    nameWidget(*this, "tour", tr("Tour"));
    setFrameShape(QFrame::StyledPanel);
    setFrameShadow(QFrame::Raised);
    setAutoFillBackground(true);
    auto* layout = new QVBoxLayout(this);
    title_ = makeLabel({}, {.name = "tourTitle", .size = TextSize::Large}, this);
    layout->addWidget(title_);
    text_ = makeLabel({}, {.name = "tourText", .wraps = true}, this);
    layout->addWidget(text_);
    auto* row = new QHBoxLayout;
    place_ = makeLabel({}, {.name = "tourPlace", .tone = Tone::Quiet}, this);
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
    if (!frame_) frame_ = new TourFrame(window());  // the frame was deleted with a dialog
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

/// Done once when the tour comes to this control: the user may scroll away afterwards.
void Tour::bringIntoView(QWidget* control) {
    if (control == shown_ || control == nullptr || !control->isVisible()) return;
    shown_ = control;
    for (auto* above = control->parentWidget(); above != nullptr; above = above->parentWidget()) {
        if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(control, 0, 0);
    }
}

/// Places the panel where it hides least of the control, preferably at the lower right, but never over STOP's bar.
void Tour::place() {
    // Less than half the window wide, so that a control beside the panel has room.
    const int wide =
        std::min(fontMetrics().averageCharWidth() * kWidthChars, parentWidget()->width() / 2 - 4 * kMargin);
    // Measured here, because after a change of text size the label still returns the old size.
    const QRect any(0, 0, wide, QWIDGETSIZE_MAX);
    text_->setFixedSize(wide, text_->fontMetrics().boundingRect(any, Qt::TextWordWrap, text_->text()).height() + 2);
    layout()->activate();
    resize(sizeHint());
    auto room = parentWidget()->rect().adjusted(kMargin, kMargin, -kMargin, -kAboveStatus);
    if (const auto* bar = parentWidget()->findChild<QWidget*>("safetyBar"))
        room.setTop(bar->mapTo(parentWidget(), QPoint(0, bar->height())).y());
    const bool beside = frame_ && frame_->isVisible() && frame_->parentWidget() == parentWidget();
    const auto control = beside ? frame_->geometry() : QRect();
    QRect best;
    int least = std::numeric_limits<int>::max();
    for (const auto down : {Qt::AlignBottom, Qt::AlignTop, Qt::AlignVCenter}) {
        for (const auto across : {Qt::AlignRight, Qt::AlignLeft, Qt::AlignHCenter}) {
            auto here = QStyle::alignedRect(Qt::LeftToRight, across | down, size(), room);
            here.moveTop(std::max(here.top(), room.top()));
            const auto hidden = (here & control).size();
            if (hidden.width() * hidden.height() >= least) continue;
            least = hidden.width() * hidden.height();
            best = here;
        }
    }
    if (geometry() != best) setGeometry(best);
    // What lies on top already must not be raised: it would be painted again each time.
    const auto& all = parentWidget()->children();
    const bool framed = !all.isEmpty() && all.back() == frame_;
    if (all.value(all.size() - (framed ? 2 : 1)) != this) raise();
    if (frame_) frame_->raise();
}

bool Tour::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

namespace {

constexpr int kLine = 3;  // pixels at the normal text size
constexpr int kHalo = 1;  // width on each side, for contrast on any background

/// Returns the visible part in the coordinates of its window; empty if nothing is visible.
QRect visiblePart(const TourTarget& target) {
    auto* widget = target.widget;
    if (widget == nullptr || !widget->isVisible()) return {};
    auto seen = widget->rect();
    if (!target.part.isNull()) seen &= target.part;
    // Leaves out what its ancestors cut off. visibleRegion() would also leave out what covers it, such as the frame.
    for (auto* inside = widget; !inside->isWindow() && inside->parentWidget() != nullptr;) {
        seen.translate(inside->pos());
        inside = inside->parentWidget();
        seen &= inside->rect();
    }
    return seen;
}

}  // namespace

TourFrame::TourFrame(QWidget* window) : QWidget(window) {
    setObjectName("tourFrame");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
}

void TourFrame::follow(const TourTarget& target) {
    const auto seen = visiblePart(target);
    if (seen.isEmpty()) return hide();
    // A dialog is another window, so the frame moves there. If the dialog deletes the frame, the tour makes a new one.
    auto* window = target.widget->window();
    if (parentWidget() != window) setParent(window);
    const int line = scaledPx(kLine) + 2 * kHalo;
    const auto around = seen.adjusted(-line, -line, line, line) & window->rect();
    if (geometry() != around) setGeometry(around);
    if (!isVisible()) show();
}

void TourFrame::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto& c = colours();
    const double line = scaledPx(kLine);
    const double inset = kHalo + line / 2;
    const auto frame = QRectF(rect()).adjusted(inset, inset, -inset, -inset);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(c.base, line + 2 * kHalo));
    painter.drawRect(frame);
    painter.setPen(QPen(c.text, line));
    painter.drawRect(frame);
}

}  // namespace tacto::gui

#include "moc_Tour.cpp"
