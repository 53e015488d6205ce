#include "app/gui/theme/EntryFields.h"

#include <QCalendarWidget>
#include <QDate>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMenu>
#include <QPushButton>
#include <QWidgetAction>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"

namespace tacto::gui {

namespace {
constexpr int kCalendarHigh = 240;
}

PathField::PathField(const QString& path, const QString& tip, QWidget* parent) : QLineEdit(parent) {
    connect(this, &QLineEdit::textChanged, this, [this, tip](const QString& text) {
        if (!hasFocus()) setCursorPosition(0);
        setToolTip(text.isEmpty() ? tip : text + "\n" + tip);
    });
    setToolTip(tip);
    setText(path);
}

FolderRow::FolderRow(const QString& path, const QString& tip, const QString& question, QWidget* parent)
    : QWidget(parent), line_(new PathField(path, tip, this)) {
    auto* row = rowIn(*this, 8);
    auto* choose = pageButton(tr("Ch&oose…"), {}, tr("Chooses the folder from a list."), this);
    connect(choose, &QPushButton::clicked, this, [this, question] {
        FileQuestion asked{.title = question, .wants = FileQuestion::Wants::NewFolder};
        for (QFileInfo above(QFileInfo(folder()).absolutePath()); !folder().isEmpty() && asked.folder.isEmpty();
             above.setFile(above.absolutePath()))
            if (above.isDir()) asked.folder = above.absoluteFilePath();
        askForFile(*this, asked, [this](const QString& chosen) { line_->setText(chosen); });
    });
    row->addWidget(line_, 1);
    row->addWidget(choose);
}

void placeInLine(QWidget& holder, QLineEdit& line, QToolButton& button) {
    auto* row = rowIn(holder, 4);
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
    nameWidget(*button_, "calendar-" + name, tr("Choose the day"), tr("Chooses the day in a calendar (Alt+Down)."));
    button_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(button_);
    auto* calendar = new QCalendarWidget(menu);
    calendar->setVerticalHeaderFormat(QCalendarWidget::NoVerticalHeader);
    calendar->setMinimumHeight(scaledPx(kCalendarHigh));  // its own hint cuts the names of the days
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
    button_->setFocusPolicy(Qt::ClickFocus);  // Tab leads to the next field: the line opens the calendar by Alt+Down
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

#include "moc_EntryFields.cpp"
