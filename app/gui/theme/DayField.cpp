#include "app/gui/theme/DayField.h"

#include <QCalendarWidget>
#include <QDate>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QWidgetAction>

#include "app/gui/theme/Icons.h"

namespace tacto::gui {

void placeInLine(QWidget& holder, QLineEdit& line, QToolButton& button) {
    auto* row = new QHBoxLayout(&holder);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(&line, 1);
    button.setFocusPolicy(Qt::StrongFocus);
    row->addWidget(&button);
}

DayField::DayField(const QString& name, const QString& meansEmpty, QWidget* parent)
    : QWidget(parent), line_(new QLineEdit(this)), button_(new QToolButton(this)) {
    line_->setObjectName(name);
    line_->setPlaceholderText(meansEmpty);
    line_->setClearButtonEnabled(true);
    line_->installEventFilter(this);
    setFocusProxy(line_);
    button_->setProperty("role", "opens");
    button_->setIcon(icon("chevron-down"));
    button_->setObjectName("calendar-" + name);
    button_->setAccessibleName(tr("Choose the day"));
    button_->setToolTip(tr("Chooses the day in a calendar (Alt+Down)."));
    button_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(button_);
    auto* calendar = new QCalendarWidget(menu);
    calendar->setVerticalHeaderFormat(QCalendarWidget::NoVerticalHeader);
    auto* action = new QWidgetAction(menu);
    action->setDefaultWidget(calendar);
    menu->addAction(action);
    button_->setMenu(menu);
    connect(menu, &QMenu::aboutToShow, calendar, [this, calendar] {
        const auto day = QDate::fromString(line_->text().trimmed(), Qt::ISODate);
        calendar->setSelectedDate(day.isValid() ? day : QDate::currentDate());
        calendar->setFocus();
    });
    const auto take = [this, menu](QDate day) {
        line_->setText(day.toString(Qt::ISODate));
        menu->close();
    };
    connect(calendar, &QCalendarWidget::clicked, line_, take);
    connect(calendar, &QCalendarWidget::activated, line_, take);
    placeInLine(*this, *line_, *button_);
}

bool DayField::eventFilter(QObject* watched, QEvent* event) {
    if (watched == line_ && event->type() == QEvent::KeyPress) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (key->key() == Qt::Key_Down && key->modifiers().testFlag(Qt::AltModifier)) {
            QMetaObject::invokeMethod(button_, &QToolButton::showMenu, Qt::QueuedConnection);
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace tacto::gui

#include "moc_DayField.cpp"
