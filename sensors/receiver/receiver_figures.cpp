#include "sensors/receiver/receiver_figures.h"

#include "sensors/receiver/detection.h"

namespace fanbeam::sensors {

double detection_threshold_W(const Sensor& sensor) {
  const Receiver& receiver = sensor.receiver;
  return sensor.noise_power_W() *
         detection_threshold(receiver.false_alarm_probability, receiver.looks) / receiver.looks;
}

ReceiverFigures receiver_figures(const Sensor& sensor) {
  const Receiver& receiver = sensor.receiver;
  const auto detectable_W = [&](core::Swerling target) {
    return sensor.noise_power_W() * required_snr(target, kDetectionProbability,
                                                 receiver.false_alarm_probability, receiver.looks);
  };
  ReceiverFigures figures;
  figures.noise_W = sensor.noise_power_W();
  figures.threshold_W = detection_threshold_W(sensor);
  figures.detectable_steady_W = detectable_W(core::Swerling::steady);
  figures.detectable_swerling1_W = detectable_W(core::Swerling::case1);
  figures.false_alarms_per_frame =
      receiver.false_alarm_probability * sensor.scan.columns * sensor.range.cells;
  return figures;
}

}  // namespace fanbeam::sensors
