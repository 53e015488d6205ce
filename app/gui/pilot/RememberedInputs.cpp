#include "app/gui/pilot/RememberedInputs.h"

#include <QSettings>
#include <QStringList>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr QChar kFieldEnd('\t');

QString keyOf(const QString& place) { return "pilot/inputs/" + place; }

/// Its identity, its person and what each button does: "046d:c216 17\tparticipant\t3 1\t1 0".
QString lineOf(const SeatedDevice& seat) {
    QStringList fields{qtext(seat.device.identity), qtext(std::string(nameOf(seat.whose)))};
    for (const auto& use : seat.uses) fields << QString("%1 %2").arg(int(use.does)).arg(use.answer);
    return fields.join(kFieldEnd);
}

/// Nothing for a text that does not say it.
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
