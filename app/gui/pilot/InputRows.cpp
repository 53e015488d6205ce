#include "app/gui/pilot/InputRows.h"

#include <QGridLayout>
#include <QSettings>
#include <QStringList>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr int kLookEvery_ms = 1000;
constexpr int kButtonsInRow = 2;
enum Assigned { kUnused, kParticipants, kOperators };

QString lampText(const std::string& button, bool down) { return (down ? "● " : "○ ") + qtext(button); }

void addUses(QComboBox& box) {
    using enum ButtonUse::Does;
    const auto add = [&](const QString& words, ButtonUse::Does does, int answer = 0) {
        box.addItem(words, QPoint(int(does), answer));
    };
    add(QObject::tr("nothing"), Nothing);
    add(QObject::tr("STOP"), Stop);
    add(QObject::tr("hold"), Hold);
    for (int i = 1; i <= kMaxAnswers; ++i) add(QObject::tr("answer %1").arg(i), Answer, i);
}

}  // namespace

InputRows::InputRows(QWidget* parent)
    : QWidget(parent), none_(new QLabel(tr("none is plugged in"), this)), column_(new QVBoxLayout(this)) {
    setObjectName("inputDevices");
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(8);
    none_->setObjectName("noInputs");
    none_->setWordWrap(true);
    none_->setToolTip(
        tr("A foot switch that types keys is a keyboard, and each key does what it does on any other: Esc is a STOP."));
    setTone(*none_, Tone::Quiet);
    column_->addWidget(none_);
    looking_.setInterval(kLookEvery_ms);
    connect(&looking_, &QTimer::timeout, this, &InputRows::look);
    connect(&open_, &OpenButtons::moved, this,
            [this](const std::string& identity, std::size_t button, bool down) { light(identity, button, down); });
    connect(&open_, &OpenButtons::plugged, this, [this] { look(); });
}

void InputRows::setDevices(std::shared_ptr<const ButtonDevices> devices) {
    open_.setDevices(std::move(devices));
    if (isVisible()) look();
}

void InputRows::setPlace(const QString& place) {
    place_ = place;
    open_.close();
    rows_.clear();
    build();
    if (isVisible()) look();
}

void InputRows::seatAsBefore(Row& row) {
    row.assigned = true;
    row.seat.whose = row.before->whose;
    row.seat.uses = row.before->uses;
}

void InputRows::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    looking_.start();
    look();
}

void InputRows::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    looking_.stop();
    open_.close();
}

void InputRows::look() {
    if (!open_.devices() || std::exchange(looks_, true)) return;
    looker_.start(
        this, [devices = open_.devices()] { return devices->list(); },
        [this](const std::vector<ButtonDeviceInfo>& found) {
            looks_ = false;
            if (isVisible()) list(found);
        });
}

InputRows::Row* InputRows::find(const std::string& identity) {
    const auto found =
        std::ranges::find_if(rows_, [&](const Row& row) { return row.seat.device.identity == identity; });
    return found == rows_.end() ? nullptr : &*found;
}

/// Rows keep their settings; the row of an unplugged device stays while the device is assigned. Devices with the same
/// identity cannot be told apart, so none of them can be assigned.
void InputRows::list(const std::vector<ButtonDeviceInfo>& found) {
    std::vector<Row> now;
    for (const auto& info : found) {
        Row row;
        const auto* before = info.obstacle.empty() ? find(info.identity) : nullptr;
        if (before != nullptr && before->seat.device.buttons == info.buttons) row = *before;
        row.seat.device = info;
        row.there = true;
        if (row.seat.uses.size() != info.buttons.size()) {
            row.seat.uses = usualUses(info.buttons.size());
            if (!place_.isEmpty() && info.obstacle.empty()) row.before = rememberedInput(place_, info);
            if (row.before && info.hasSerial) seatAsBefore(row);
        }
        now.push_back(std::move(row));
    }
    for (const auto& row : rows_) {
        const bool stays = std::ranges::any_of(
            now, [&](const Row& one) { return one.seat.device.identity == row.seat.device.identity; });
        if (stays || !row.assigned) continue;
        now.push_back(row);
        now.back().there = false;
    }
    const auto same = [](const Row& a, const Row& b) {
        return a.seat.device == b.seat.device && a.there == b.there && a.trouble == b.trouble;
    };
    for (auto& row : now) tryOpen(row);
    if (std::ranges::equal(now, rows_, same)) return;
    rows_ = std::move(now);
    build();
    emit changed();
}

void InputRows::tryOpen(Row& row) {
    row.trouble = qtext(row.seat.device.obstacle);
    if (!row.there || !row.trouble.isEmpty()) return open_.close(row.seat.device.identity);
    if (const auto opened = open_.open(row.seat.device); !opened) row.trouble = sentence(opened.error());
}

void InputRows::build() {
    while (column_->count() > 1) {
        auto* item = column_->takeAt(1);
        item->widget()->hide();
        item->widget()->deleteLater();  // perhaps called from this row's own box
        delete item;
    }
    none_->setVisible(rows_.empty());
    for (auto& row : rows_) column_->addWidget(build(row));
}

QWidget* InputRows::build(Row& row) {
    const auto& device = row.seat.device;
    row.widget = new QWidget(this);
    auto* column = columnIn(*row.widget, 4);
    auto* whose = new QComboBox(row.widget);
    nameWidget(*whose, "inputOf " + qtext(device.identity), tr("Whose %1 is").arg(qtext(device.name)));
    whose->addItem(tr("not used"));
    whose->addItem(tr("the participant’s"));
    whose->addItem(tr("the operator’s"));
    whose->setCurrentIndex(!row.assigned                             ? kUnused
                           : row.seat.whose == PromptTo::Participant ? kParticipants
                                                                     : kOperators);
    whose->setEnabled(row.trouble.isEmpty());
    auto* line = new QHBoxLayout;
    line->setSpacing(8);
    auto* name = makeLabel(qtext(device.name), {.wraps = true, .plain = true}, row.widget);
    name->setToolTip(qtext(device.identity + ", " + device.address));
    line->addWidget(name, 1);
    line->addWidget(whose);
    column->addLayout(line);
    connect(whose, &QComboBox::activated, this, [this, identity = device.identity](int chosen) {
        auto* mine = find(identity);
        if (mine == nullptr) return;
        mine->assigned = chosen != kUnused;
        mine->seat.whose = chosen == kOperators ? PromptTo::Operator : PromptTo::Participant;
        build();
        emit changed();
    });
    const auto trouble = !row.there ? tr("It is unplugged.") : row.trouble;
    if (!trouble.isEmpty()) {
        column->addWidget(makeLabel("⚠ " + trouble, {.tone = Tone::Warning, .wraps = true, .plain = true}, row.widget));
    }
    buildBefore(row, *column);
    row.lamps.clear();
    buildButtons(row, *column);
    return row.widget;
}

/// Says if the device is used as in the last session, or offers to copy the last use of a device of its model.
void InputRows::buildBefore(Row& row, QVBoxLayout& column) {
    if (!row.before || !row.there || !row.trouble.isEmpty()) return;
    const bool same = row.assigned && row.seat.whose == row.before->whose && row.seat.uses == row.before->uses;
    if (!same && row.assigned) return;
    const auto whose = row.before->whose == PromptTo::Participant ? tr("the participant’s") : tr("the operator’s");
    auto* told = makeLabel({}, {.name = "asLastTime", .tone = Tone::Quiet, .wraps = true, .plain = true}, row.widget);
    told->setText(same ? tr("As in the last session.")
                  : row.seat.device.hasSerial
                      ? tr("In the last session it was %1.").arg(whose)
                      : tr("In the last session a device of this model was %1. It has no serial number, so this may be "
                           "another one: press one of its buttons first.")
                            .arg(whose));
    column.addWidget(told);
    if (same) return;
    auto* again = new QPushButton(tr("As in the last session"), row.widget);
    again->setObjectName("seatAsBefore " + qtext(row.seat.device.identity));
    again->setAutoDefault(false);
    column.addWidget(again, 0, Qt::AlignLeft);
    connect(again, &QPushButton::clicked, this, [this, identity = row.seat.device.identity] {
        auto* mine = find(identity);
        if (mine == nullptr || !mine->before) return;
        seatAsBefore(*mine);
        build();
        emit changed();
    });
}

/// Shows an unused device as one line that names the pressed button, so that the operator can tell devices apart.
void InputRows::buildButtons(Row& row, QVBoxLayout& column) {
    const auto& buttons = row.seat.device.buttons;
    if (!row.there || !row.trouble.isEmpty()) return;
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    column.addLayout(grid);
    if (!row.assigned) {
        auto* hint = makeLabel(tr("Press a button to see which device it is."),
                               {.name = "pressIt", .tone = Tone::Quiet, .wraps = true}, row.widget);
        grid->addWidget(hint, 0, 0);
        row.lamps.assign(buttons.size(), hint);
        return;
    }
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        auto* lamp = new QLabel(lampText(buttons[i], false), row.widget);
        lamp->setObjectName(QString("lamp %1").arg(qtext(buttons[i])));
        auto* use = new QComboBox(row.widget);
        nameWidget(*use, QString("use %1").arg(qtext(buttons[i])), tr("What button %1 does").arg(qtext(buttons[i])));
        addUses(*use);
        use->setCurrentIndex(use->findData(QPoint(int(row.seat.uses[i].does), row.seat.uses[i].answer)));
        const int at = int(i) / kButtonsInRow, cell = int(i) % kButtonsInRow * 2;
        grid->addWidget(lamp, at, cell);
        grid->addWidget(use, at, cell + 1);
        row.lamps.push_back(lamp);
        connect(use, &QComboBox::activated, this, [this, use, i, identity = row.seat.device.identity] {
            auto* mine = find(identity);
            if (mine == nullptr || i >= mine->seat.uses.size()) return;
            const auto chosen = use->currentData().toPoint();
            mine->seat.uses[i] = {ButtonUse::Does(chosen.x()), chosen.y()};
            emit changed();
        });
    }
    grid->setColumnStretch(kButtonsInRow * 2, 1);
}

void InputRows::light(const std::string& identity, std::size_t button, bool down) {
    auto* row = find(identity);
    if (row == nullptr || button >= row->lamps.size()) return;
    const auto& name = row->seat.device.buttons[button];
    row->lamps[button]->setText(row->assigned ? lampText(name, down)
                                : down        ? tr("● button %1 is down").arg(qtext(name))
                                              : tr("Press a button to see which device it is."));
    setTextSize(*row->lamps[button], TextSize::Body, down);
}

std::vector<SeatedDevice> InputRows::seats() const {
    std::vector<SeatedDevice> all;
    for (const auto& row : rows_) {
        if (row.assigned) all.push_back(row.seat);
    }
    return all;
}

QString InputRows::missing() const {
    for (const auto& row : rows_) {
        if (!row.assigned) continue;
        const auto name = qtext(row.seat.device.name);
        if (!row.there) return tr("%1 is unplugged. Plug it in, or choose “not used”.").arg(name);
        if (!row.trouble.isEmpty()) return row.trouble;
        const bool idle =
            std::ranges::all_of(row.seat.uses, [](const auto& use) { return use.does == ButtonUse::Does::Nothing; });
        if (idle) return tr("No button of %1 does anything. Choose STOP or an answer for one.").arg(name);
    }
    return {};
}

namespace {

constexpr QChar kFieldEnd('\t');

QString keyOf(const QString& place) { return "pilot/inputs/" + place; }

/// Returns a device's identity, its person and the use of each button: "046d:c216 17\tparticipant\t3 1\t1 0".
QString lineOf(const SeatedDevice& seat) {
    QStringList fields{qtext(seat.device.identity), qtext(std::string(nameOf(seat.whose)))};
    for (const auto& use : seat.uses) fields << QString("%1 %2").arg(int(use.does)).arg(use.answer);
    return fields.join(kFieldEnd);
}

/// Returns nothing if the text is not a button's use as lineOf() writes it.
std::optional<ButtonUse> useFrom(const QString& text) {
    const auto numbers = text.split(' ');
    if (numbers.size() != 2) return std::nullopt;
    bool isDoes = false, isAnswer = false;
    const int does = numbers[0].toInt(&isDoes), answer = numbers[1].toInt(&isAnswer);
    const bool answers = does == int(ButtonUse::Does::Answer);
    if (!isDoes || !isAnswer || does < 0 || does > int(ButtonUse::Does::Answer)) return std::nullopt;
    if (answers ? answer < 1 || answer > kMaxAnswers : answer != 0) return std::nullopt;
    return ButtonUse{ButtonUse::Does(does), answer};
}

}  // namespace

void rememberInputs(const QString& place, const std::vector<SeatedDevice>& seats) {
    QStringList lines;
    for (const auto& seat : seats) lines << lineOf(seat);
    QSettings().setValue(keyOf(place), lines);
}

std::optional<SeatedDevice> rememberedInput(const QString& place, const ButtonDeviceInfo& device) {
    for (const auto& line : QSettings().value(keyOf(place)).toStringList()) {
        const auto fields = line.split(kFieldEnd);
        if (fields.size() != qsizetype(device.buttons.size()) + 2 || fields[0] != qtext(device.identity)) continue;
        SeatedDevice seat;
        seat.device = device;
        if (fields[1] == qtext(std::string(nameOf(PromptTo::Operator))))
            seat.whose = PromptTo::Operator;
        else if (fields[1] != qtext(std::string(nameOf(PromptTo::Participant))))
            continue;
        for (qsizetype i = 2; i < fields.size(); ++i) {
            if (const auto use = useFrom(fields[i])) seat.uses.push_back(*use);
        }
        if (seat.uses.size() == device.buttons.size()) return seat;
    }
    return std::nullopt;
}

}  // namespace tacto::gui

#include "moc_InputRows.cpp"
