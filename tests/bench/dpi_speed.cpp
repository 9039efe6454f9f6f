// What dpi_speed.sv cannot ask its simulator.
#include <ctime>

extern "C" double dpi_speed_cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
