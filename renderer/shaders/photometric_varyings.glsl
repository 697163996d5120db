// What the vertex stage of `photometric` hands to the fragment stage. STAGE_IO is `out` or `in`.
#if WANT_SEEN
flat STAGE_IO vec4 v_albedo; // w: retro_rl
#if TEXTURED
STAGE_IO vec2 v_uv;
flat STAGE_IO vec4 v_blend; // w: texture layer
flat STAGE_IO int v_texture_mode;
flat STAGE_IO float v_rl_per_y; // retro_rl over the own colour's luminance
#endif
#if EMISSIVE
flat STAGE_IO vec3 v_emission;
#endif
#if RETRO
flat STAGE_IO vec2 v_retro; // reference angle, 1 / fall-off
#if RETRO_TINT
flat STAGE_IO vec3 v_tint;
#endif
#endif
#endif
#if GLOSS || BEADS
flat STAGE_IO vec3 v_gloss; // share, roughness, retroreflection left under water
#endif
#if TRAFFIC
STAGE_IO vec3 v_traffic_p; // relative to the car
STAGE_IO vec3 v_traffic_n; // not yet of unit length
STAGE_IO vec4 v_traffic_light; // of what is drawn by vertex: colour times lux, lux
STAGE_IO vec2 v_traffic_cell;  // in cells from the grid's corner
flat STAGE_IO uvec2 v_traffic_list;
flat STAGE_IO vec4 v_traffic_eye; // as eye of a lamp, along the world's axes
#endif
#if SKY || SUN
STAGE_IO vec3 v_normal;
#endif
#if SKY
flat STAGE_IO float v_sky_lx;
#endif
#if SUN
flat STAGE_IO vec4 v_sun; // towards sun or moon; w: lx on a plane across its light
#if SUN_SHADOWS
STAGE_IO vec3 v_sun_at; // in its shadow map, of a point raised above the surface
#endif
#endif
#if FOG || WET || GLOSS
STAGE_IO vec3 v_from_eye;
#endif
#if FOG
flat STAGE_IO vec4 v_fog; // extinction on the way from a lamp and on that to the eye, scattering, g
#endif
#if FOG || WET || GLOSS
flat STAGE_IO float v_sky_cdm2;
#endif
#if LAMPS_IN_FOG
flat STAGE_IO vec4 v_air; // eye; number of lamps of others seen in the air
flat STAGE_IO float v_air_min_cdm2;
#endif
#if WET
flat STAGE_IO float v_wet; // 0 dry .. 1 under water
#endif
#if WANT_DEPTH
STAGE_IO float v_depth_m;
#endif
#if WANT_IDS
flat STAGE_IO uint v_mesh;
#endif
#ifdef SHADOW_LIFT
STAGE_IO float v_level; // upward part of the normal, not yet of unit length, of ground; else 0
#endif
#if LAMP_COUNT > 0
STAGE_IO vec3 v_w[LAMP_COUNT];      // the point in lamp space
STAGE_IO vec3 v_n[LAMP_COUNT];      // its normal in lamp space, not yet of unit length
#if LAMPS_BY_VERTEX // not where many lamps would need more of these than there are
flat STAGE_IO vec4 v_colour[LAMP_COUNT]; // linear sRGB of luminance 1; w: intensity factor
#if WANT_TARGET
flat STAGE_IO vec3 v_raise[LAMP_COUNT]; // from the point to the target above it
#endif
#if WANT_SEEN && (RETRO || FOG || WET || GLOSS)
flat STAGE_IO vec4 v_eye[LAMP_COUNT]; // in lamp space; w: 1 a place, 0 a direction
#endif
#endif
#endif
