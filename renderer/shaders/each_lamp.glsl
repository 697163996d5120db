// Calls a macro for each lamp, with its number and the names of its samplers. Samplers take constant indices alone: llvmpipe of Mesa 25 ends
// the process where a shader fetches by a variable index from an array of samplers and has an array texture beside it.
#define LAMPS_1(OF) OF(0, beam_0, shadow_0)
#define LAMPS_2(OF) LAMPS_1(OF) OF(1, beam_1, shadow_1)
#define LAMPS_3(OF) LAMPS_2(OF) OF(2, beam_2, shadow_2)
#define LAMPS_4(OF) LAMPS_3(OF) OF(3, beam_3, shadow_3)
#define LAMPS_5(OF) LAMPS_4(OF) OF(4, beam_4, shadow_4)
#define LAMPS_6(OF) LAMPS_5(OF) OF(5, beam_5, shadow_5)
#define LAMPS_7(OF) LAMPS_6(OF) OF(6, beam_6, shadow_6)
#define LAMPS_8(OF) LAMPS_7(OF) OF(7, beam_7, shadow_7)
#if LAMP_COUNT == 1
#define EACH_LAMP(OF) LAMPS_1(OF)
#elif LAMP_COUNT == 2
#define EACH_LAMP(OF) LAMPS_2(OF)
#elif LAMP_COUNT == 3
#define EACH_LAMP(OF) LAMPS_3(OF)
#elif LAMP_COUNT == 4
#define EACH_LAMP(OF) LAMPS_4(OF)
#elif LAMP_COUNT == 5
#define EACH_LAMP(OF) LAMPS_5(OF)
#elif LAMP_COUNT == 6
#define EACH_LAMP(OF) LAMPS_6(OF)
#elif LAMP_COUNT == 7
#define EACH_LAMP(OF) LAMPS_7(OF)
#elif LAMP_COUNT == 8
#define EACH_LAMP(OF) LAMPS_8(OF)
#endif
