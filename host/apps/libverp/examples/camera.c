/* camera FILE.ppm [SECONDS]: walks through a room, writes the robot's last view to FILE and renders
 * a picture of the robot. */
#include "host/apps/libverp/examples/check.h"

static double mean(const uint8_t* picture, size_t size) {
  double sum = 0;
  for (size_t i = 0; i < size; ++i) sum += picture[i];
  return sum / (double)size;
}

int main(int argc, char** argv) {
  verp_session session;
  verp_world world = {.size = sizeof world, .file = "demo"};
  verp_robot robot;
  verp_camera camera = {.size = sizeof camera};
  verp_view view = {.size = sizeof view, .width = 320, .height = 240, .name = "follow"};
  static uint8_t outside[3 * 320 * 240];
  double time_s;
  if (argc < 2) return fprintf(stderr, "usage: camera FILE.ppm [SECONDS]\n"), 2;
  check(verp_robot_defaults(&robot));
  if (argc > 2) robot.walk_s = atof(argv[2]);
  check(verp_session_open(&world, &session));
  check(verp_session_add(session, &robot, NULL));
  while (check(verp_session_tick(session, 100, NULL, NULL)) == VERP_OK) {
  }
  check(verp_session_camera(session, 0, 0, &camera));
  const size_t size = (size_t)3 * camera.width * camera.height;
  uint8_t* seen = malloc(size);
  check(verp_session_picture(session, 0, 0, VERP_COLOUR, seen, size, &time_s));
  check(verp_session_render(session, &view, outside, sizeof outside));
  printf("%s: %ux%u at %.2f s, mean %.1f; from outside %.1f\n", camera.name, camera.width,
         camera.height, time_s, mean(seen, size), mean(outside, sizeof outside));
  FILE* file = fopen(argv[1], "wb");
  if (file == NULL) return perror(argv[1]), 1;
  fprintf(file, "P6\n%u %u\n255\n", camera.width, camera.height);
  fwrite(seen, 1, size, file);
  free(seen);
  check(verp_session_close(session));
  return fclose(file);
}
